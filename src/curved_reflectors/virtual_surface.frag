// What curved reflectors show: surfaces that mirror the sky alone, where virtual_vertices.vert has put them.
#include "render/surface.frag"
#include "curved_reflectors/patch_uniforms.glsl"

in float is_lost;  // 0 where all corners have a place in the mirror image
in float height;   // above the reflector; what lies below it is hidden
in vec3 shown_by;  // the reflector's normal there

// Corners that places show which face too far apart, by more than 25 degrees, tell nothing of what lies between them.
const float least_agreement = 0.95f;
const float strayed_error = 2.5e-3f;  // 0.1 radians between bisector and normal

// A triangle whose corners ended in different images of it shows nothing: between them lies no reflection point.
bool is_mirrored_here() {
  if (is_lost > 0.0f || height < 0.0f) return false;
  if (patch_layer < 0) return dot(shown_by, shown_by) >= least_agreement;
  SurfacePoint at = surface_at(moved(reflector_from_world, seen_from) - map_centre);
  vec3 viewer = moved(reflector_from_world, viewer_position.xyz), vertex = moved(reflector_from_world, position);
  return bisector_error(bisector(viewer, vertex, at), at.normal) < strayed_error;
}
