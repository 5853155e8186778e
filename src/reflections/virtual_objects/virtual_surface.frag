// What curved reflectors show: surfaces that mirror the sky, or what near_picture.glsl shows in them, where
// virtual_vertices.vert has put them.
#include "graphics/render/surface.frag"
#include "reflections/reflector_maps/patch_uniforms.glsl"
#include "reflections/virtual_objects/mirrored_triangle.glsl"

in float certainty;
in float height;
in vec3 shown_by;

const float max_beside_px = 3.0f;

// Distance in pixels from this pixel to the place that shows the point.
float beside_px() {
  vec4 clip = clip_from_world * vec4(seen_from, 1.0f);
  return distance((0.5f * clip.xy / clip.w + 0.5f) * frame_size.xy, gl_FragCoord.xy);
}

// A triangle whose corners ended in different images of it, or at places that face too far apart (at the foot
// of what stands on it), is shown where it is mirrored after all: between the images lies no reflection
// point. One with a doubtful corner reaches over where the patch shows nothing, as beside a rim that flares:
// only where the pixel itself shows it.
bool is_mirrored_here() {
  // A corner must be sure, and none lost. Beyond a triangle's edge, where the middle of a pixel may lie,
  // certainty turns negative.
  if (abs(certainty) > 0.999f * doubtful || height < 0.0f) return false;
  bool is_doubtful = certainty != sure;
  if (patch_layer < 0 && !is_doubtful && dot(shown_by, shown_by) >= min_agreement) return true;
  if (is_doubtful && beside_px() > max_beside_px) return false;
  return is_mirrored(moved(reflector_from_world, viewer_position.xyz), moved(reflector_from_world, seen_from),
                     moved(reflector_from_world, position));
}
