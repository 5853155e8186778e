#!/usr/bin/env bash
# GDAL decodes a DXF of AutoCAD 2007 or later, which is UTF-8, by its $DWGCODEPAGE, and leaves \U+00E9 as it stands in texts
# and in names of layers: a filter on the layer "Forêt" finds nothing, with status 0.
. "$(dirname "$0")/packages.sh"
need gdal-bin=3.6.2+dfsg-1+b2
export GDAL_DATA="$root/installed/usr/share/gdal"
drawing() {  # file, version, layer: one text in it
  printf '%s\n' 0 SECTION 2 HEADER 9 '$ACADVER' 1 "$2" 9 '$DWGCODEPAGE' 3 ANSI_1252 0 ENDSEC \
    0 SECTION 2 ENTITIES 0 TEXT 8 "$3" 10 1.0 20 2.0 30 0.0 40 1.0 1 "$3" 0 ENDSEC 0 EOF > "$1"
}
drawing utf8.dxf AC1021 'Forêt'
drawing escaped.dxf AC1015 'For\U+00EAt'
for name in utf8 escaped; do
  echo "$name:"
  ogrinfo -ro -al $name.dxf > $name.txt
  grep -E '^  (Layer|Text) ' $name.txt
  ogrinfo -ro -al -where "Layer = 'Forêt'" $name.dxf > $name.found
  grep '^Feature Count' $name.found
done
is_found() { grep -q "$2" $1.txt && grep -q '^Feature Count: 0' $1.found; }
expect "UTF-8 is read as Windows-1252" is_found utf8 'Layer (String) = ForÃªt$'
expect "an escape stays as it stands" is_found escaped 'Layer (String) = For\\U+00EAt$'
