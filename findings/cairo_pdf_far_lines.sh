#!/usr/bin/env bash
# cairo keeps coordinates in 24 bits before the point: on a PDF a line beyond 8,388,607 points comes out on the other side of the
# page, without an error. A survey's coordinates (Lambert-93: six million metres) do that at 1:1000 already. A line of width 0, the
# thinnest one in PDF, is not drawn at all.
. "$(dirname "$0")/packages.sh"
need libcairo2=1.16.0-7 python3-cairo=1.20.1-5+b1 poppler-utils=22.12.0-2+deb12u3
cat > lines.py <<'PY'
import cairo
def page(name, to, width):
    surface = cairo.PDFSurface(name, 200, 200)
    context = cairo.Context(surface)
    context.set_line_width(width)
    context.move_to(100, 100)
    context.line_to(to, 100)
    context.stroke()
    surface.finish()
page("near.pdf", 1e6, 1)   # to the right
page("far.pdf", 1e7, 1)    # to the right, too
page("thin.pdf", 1e6, 0)
PY
PYTHONPATH=$root/installed/usr/lib/python3/dist-packages /usr/bin/python3 lines.py
# Dark pixels of the left and the right half of the page.
halves() {
  pdftoppm -r 72 -gray "$1.pdf" "$1"
  /usr/bin/python3 -c "
import sys
data = open('$1-1.pgm', 'rb').read()[-200 * 200:]
dark = [i % 200 for i, value in enumerate(data) if value < 200]
print(sum(x < 99 for x in dark) > 0, sum(x > 101 for x in dark) > 0)"
}
is_drawn() { echo "$1: left and right of the middle: $(halves "$1")"; [ "$(halves "$1")" = "$2" ]; }
expect "a line to 1,000,000 points goes to the right" is_drawn near "False True"
expect "a line to 10,000,000 points goes to the left" is_drawn far "True False"
expect "a line of width 0 is not there" is_drawn thin "False False"
