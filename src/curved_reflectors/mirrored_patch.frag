// Depth and stencil alone, where the first reflector shows the second.
#include "curved_reflectors/mirrored_triangle.glsl"

in float is_lost;
in float height;
in vec3 shown_by;

void main() {
  if (!is_shown_whole(is_lost, height, shown_by)) discard;
}
