#!/usr/bin/env bash
# LibreCAD draws entities whose extrusion is (0, 0, -1), as mirrored blocks have them, in other places by kind: LINE, ARC and
# LWPOLYLINE where the DXF reference puts them; POLYLINE and INSERT unmirrored, at x in place of -x; ELLIPSE, which is given in
# world coordinates, turned half round its centre.
. "$(dirname "$0")/packages.sh"
need librecad=2.2.0-1 poppler-utils=22.12.0-2+deb12u3
export QT_QPA_PLATFORM=offscreen HOME=$PWD QT_PLUGIN_PATH=$root/installed/usr/lib/x86_64-linux-gnu/qt5/plugins
line() { printf '%s\n' 0 LINE 8 0 10 "$1" 20 "$2" 30 0 11 "$3" 21 "$4" 31 0; }
# A frame from (-20, -20) to (20, 20), by which the page is measured, then the entity.
drawing() {  # kind, group codes
  {
    printf '%s\n' 0 SECTION 2 HEADER 9 '$ACADVER' 1 AC1015 9 '$INSUNITS' 70 6 0 ENDSEC 0 SECTION 2 BLOCKS 0 BLOCK 8 0 2 B 70 0 10 0 20 0 30 0 3 B
    line 0 0 2 0
    printf '%s\n' 0 ENDBLK 8 0 0 ENDSEC 0 SECTION 2 ENTITIES
    line -20 -20 20 -20; line 20 -20 20 20; line 20 20 -20 20; line -20 20 -20 -20
    printf '%s\n' 0 "$@" 0 ENDSEC 0 EOF
  } > "$1.dxf"
  librecad dxf2pdf -c -p 420x297 -s 0.005 "$1.dxf" > /dev/null 2>&1
  pdftocairo -svg "$1.pdf" "$1.svg"
}
plane=(210 0 220 0 230 -1)
drawing LINE 8 0 10 1 20 2 30 0 11 3 21 4 31 0 "${plane[@]}"
drawing ARC 8 0 10 10 20 5 30 0 40 2 50 0 51 90 "${plane[@]}"
drawing ELLIPSE 8 0 10 10 20 5 30 0 11 3 21 0 31 0 "${plane[@]}" 40 0.5 41 0 42 1.570796326794897
drawing LWPOLYLINE 8 0 90 3 70 0 10 1 20 1 10 4 20 1 10 4 20 3 "${plane[@]}"
drawing POLYLINE 8 0 66 1 10 0 20 0 30 0 70 0 "${plane[@]}" 0 VERTEX 8 0 10 1 20 1 30 0 0 VERTEX 8 0 10 4 20 1 30 0 0 VERTEX 8 0 10 4 20 3 30 0 0 SEQEND 8 0
drawing INSERT 8 0 2 B 10 10 20 5 30 0 50 30 "${plane[@]}"
# The extent of what is drawn beside the frame: "x -12..-10 y 5..7".
extent() {
  python3 - "$1.svg" <<'PY'
import re, sys
paths = [[tuple(map(float, p)) for p in re.findall(r"(-?[\d.]+) (-?[\d.]+)", d)] for d in re.findall(r'<path style="[^"]*" d="([^"]*)"', open(sys.argv[1]).read())]
frame = [p for path in paths[:4] for p in path]
left, right, top = min(x for x, y in frame), max(x for x, y in frame), min(y for x, y in frame)
scale = 40 / (right - left)
drawn = [((x - left) * scale - 20, 20 - (y - top) * scale) for path in paths[4:] for x, y in path]
f = lambda values: f"{min(values):.1f}..{max(values):.1f}".replace("-0.0", "0.0")
print("x", f([x for x, y in drawn]), "y", f([y for x, y in drawn]))
PY
}
is_at() { echo "$1: $(extent "$1")"; [ "$(extent "$1")" = "$2" ]; }
expect "LINE is in the world: 1..3" is_at LINE "x 1.0..3.0 y 2.0..4.0"
expect "ARC about (10, 5) lies about (-10, 5)" is_at ARC "x -12.0..-10.0 y 5.0..7.0"
expect "LWPOLYLINE lies at -x" is_at LWPOLYLINE "x -4.0..-1.0 y 1.0..3.0"
expect "POLYLINE of the same corners lies at x; expected -4..-1" is_at POLYLINE "x 1.0..4.0 y 1.0..3.0"
expect "INSERT lies at x; expected -11.7..-10" is_at INSERT "x 10.0..11.7 y 5.0..6.0"
expect "ELLIPSE lies at 7..10, 5..6.5; expected 10..13, 3.5..5" is_at ELLIPSE "x 7.0..10.0 y 5.0..6.5"
