// Depth, stencil, and that nothing is shown yet, where the first reflector shows the second.
#include "reflections/reflector_maps/patch_uniforms.glsl"
#include "reflections/virtual_objects/mirrored_triangle.glsl"

#include "reflections/virtual_objects/second_mirror_block.glsl"

in float certainty;
in float height;
in vec3 shown_by;
in vec3 seen_from;
in vec3 at_second;
out vec4 radiance;

void main() {
  if (!is_shown_whole(certainty, height, shown_by)) discard;
  // Layers hold the corners of a triangle in different images.
  if (patch_layer >= 0 &&
      !is_mirrored(moved(reflector_from_world, viewer_in_world.xyz), moved(reflector_from_world, seen_from),
                   moved(reflector_from_world, at_second)))
    discard;
  radiance = vec4(0.0f);
}
