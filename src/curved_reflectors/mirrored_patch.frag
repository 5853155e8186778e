// Depth, stencil, and that nothing is shown yet, where the first reflector shows the second.
#include "curved_reflectors/mirrored_triangle.glsl"

in float doubt;
in float height;
in vec3 shown_by;
out vec4 radiance;

void main() {
  if (!is_shown_whole(doubt, height, shown_by)) discard;
  radiance = vec4(0.0f);
}
