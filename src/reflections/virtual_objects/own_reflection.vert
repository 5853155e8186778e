// A concave surface, for own_reflection.frag.
layout(location = 0) in vec3 reflector_position;

#include "reflections/reflector_maps/patch_view_block.glsl"

out vec3 at_reflector;

void main() {
  at_reflector = reflector_position;
  gl_Position = clip_from_reflector * vec4(reflector_position, 1.0f);
}
