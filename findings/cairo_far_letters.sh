#!/usr/bin/env bash
# cairo_text_path leaves out letters that lie more than ten font sizes beside the surface, without an error: outlines of a long
# text lack its end.
. "$(dirname "$0")/packages.sh"
need libcairo2=1.16.0-7 python3-cairo=1.20.1-5+b1 fonts-dejavu-core=2.37-6
cat > letters.py <<'PY'
import cairo
context = cairo.Context(cairo.ImageSurface(cairo.Format.A8, 1, 1))
context.set_font_size(100)
def letters(text):
    context.new_path()
    context.move_to(0, 0)
    context.text_path(text)
    return sum(kind == cairo.PathDataType.CLOSE_PATH for kind, points in context.copy_path())
print(cairo.cairo_version_string(), letters("l" * 10), letters("l" * 100), context.text_extents("l" * 100).x_advance > 2000)
PY
result=$(PYTHONPATH=$root/installed/usr/lib/python3/dist-packages /usr/bin/python3 letters.py)
echo "$result"
is_cut() { read -r version ten hundred is_wide <<< "$result"; [ "$version $ten $is_wide" = "1.16.0 10 True" ] && [ "$hundred" -lt 60 ]; }
expect "the path of ten letters has ten outlines, that of a hundred less than sixty" is_cut
