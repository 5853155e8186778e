// A concave surface that mirrors itself: the mirror ray of each pixel walks through the surface's own map,
// and where it hits the surface, that mirrors the sky, as all that is mirrored does.
#include "graphics/render/sky_lookup.glsl"
#include "reflections/reflector_maps/patch_uniforms.glsl"

#include "reflections/reflector_maps/patch_view_block.glsl"

in vec3 at_reflector;
out vec4 radiance;

const int walk_steps = 48;
const int halvings = 6;
const float mirror_roughness = 0.05f;

// How far a point lies beyond what the centre sees that way; below 0: in front of the surface.
float beyond(vec3 point) {
  vec3 from_centre = point - map_centre;
  return length(from_centre) - map_sample(map_window(), normalize(from_centre)).distance;
}

void main() {
  SurfacePoint at = surface_at(at_reflector - map_centre);
  vec3 direction = reflect(normalize(at.position - viewer_in_reflector.xyz), at.normal);
  float step_m = 2.0f * map_size.z / float(walk_steps);
  float inside = 0.0f, outside = 0.0f;
  for (int i = 1; i <= walk_steps && outside == 0.0f; ++i) {
    float along = step_m * float(i);
    if (beyond(at.position + along * direction) < 0.0f)
      inside = along;
    else
      outside = along;
  }
  if (inside == 0.0f || outside == 0.0f) discard;  // it leaves at once, or hits nothing
  for (int i = 0; i < halvings; ++i) {
    float along = 0.5f * (inside + outside);
    if (beyond(at.position + along * direction) < 0.0f)
      inside = along;
    else
      outside = along;
  }
  vec3 from_centre = at.position + outside * direction - map_centre;
  if (surface_kind(from_centre) == kind_closed) discard;  // out through the opening
  SurfacePoint met = surface_at(from_centre);
  vec3 normal = normalize(mat3(world_from_reflector) * met.normal);
  vec3 mirrored = reflect(normalize(mat3(world_from_reflector) * direction), normal);
  vec4 cell = sky_visibility_cell(moved(world_from_reflector, met.position), normal);
  radiance = vec4(
      mirror_colour.rgb * sky_share_of_direction(cell, mirrored) * sky_radiance(mirrored, mirror_roughness),
      1.0f);
}
