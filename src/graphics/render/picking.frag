// Which object a pixel shows: its index and 1; 0 where there is none.
#include "graphics/render/cutout.glsl"

flat in uint object_of_fragment;
out uint object_and_one;

void main() {
  discard_holes();
  object_and_one = object_of_fragment + 1u;
}
