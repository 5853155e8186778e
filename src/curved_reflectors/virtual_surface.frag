// What curved reflectors show: surfaces that mirror the sky, or what HAS_NEAR_PICTURE has found in them, where virtual_vertices.vert has put them.
#include "render/surface.frag"
#include "curved_reflectors/patch_uniforms.glsl"
#include "curved_reflectors/mirrored_triangle.glsl"

in float is_lost;
in float height;
in vec3 shown_by;

const float strayed_error = 2.5e-3f;  // 0.1 radians between bisector and normal

// A triangle whose corners ended in different images of it, or at places that face too far apart (at the foot of what stands on
// it), is shown where it is mirrored after all: between the images lies no reflection point.
bool is_mirrored_here() {
  if (is_lost > 0.0f || height < 0.0f) return false;
  if (patch_layer < 0 && dot(shown_by, shown_by) >= least_agreement) return true;
  SurfacePoint at = surface_at(moved(reflector_from_world, seen_from) - map_centre);
  vec3 viewer = moved(reflector_from_world, viewer_position.xyz), vertex = moved(reflector_from_world, position);
  return bisector_error(bisector(viewer, vertex, at), at.normal) < strayed_error;
}
