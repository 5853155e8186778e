#!/usr/bin/env bash
# GDAL writes a sloping polygon into a DXF as a level hatch halfway up, and a vertical wall as a level hatch without area,
# both with status 0 and without a message.
. "$(dirname "$0")/packages.sh"
need gdal-bin=3.6.2+dfsg-1+b2
write() {  # name, ring
  cat > "$1.json" <<JSON
{"type": "FeatureCollection", "features": [{"type": "Feature", "properties": {"Layer": "0"},
 "geometry": {"type": "Polygon", "coordinates": [[$2]]}}]}
JSON
  GDAL_DATA="$root/installed/usr/share/gdal" ogr2ogr -f DXF "$1.dxf" "$1.json" 2> "$1.err" || { echo "status $?"; exit 1; }
}
write slope "[0,0,0],[10,0,0],[10,10,8],[0,10,8],[0,0,0]"
write wall "[0,0,0],[10,0,0],[10,0,8],[0,0,8],[0,0,0]"
pairs() { tr -d '\r' < "$1.dxf" | paste - - | tr -d ' ' | sed -n '/ENTITIES/,/ENDSEC/p' | tr '\t' '='; }  # code=value, a line each
corners() { pairs "$1" | sed -n '/^93=/,/^97=/p' | grep -E '^[123]0=' | paste -sd' '; }
for name in slope wall; do
  echo "$name: $(pairs $name | grep -E '^0=[A-Z]' | paste -sd' '), height $(pairs $name | sed -n 's/^30=//p'), corners $(corners $name)"
done
is_level() { [ "$(pairs slope | sed -n 's/^30=//p')" = 4 ] && [ "$(corners slope)" = "10=0 20=0 10=10 20=0 10=10 20=10 10=0 20=10 10=0 20=0" ]; }
has_no_area() { [ "$(pairs wall | sed -n 's/^30=//p')" = 4 ] && ! corners wall | grep -qE '20=[^0]'; }
is_silent() { [ ! -s slope.err ] && [ ! -s wall.err ]; }
expect "a polygon from 0 to 8 m lies level at 4 m" is_level
expect "a wall of 10 x 8 m is a hatch whose corners lie on one line" has_no_area
expect "status 0, and no message" is_silent
