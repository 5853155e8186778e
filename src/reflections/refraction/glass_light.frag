// Light of the surroundings through a body of solid glass: each pixel's ray is refracted into the body,
// traced through its map, refracted out again, and looks up the cube map of the surroundings; so do the rays
// that are reflected inside. `shown_part` selects the part that is drawn: virtual objects are drawn in
// between.
#include "graphics/render/sky_lookup.glsl"
#include "reflections/methods/cube_map_lookup.glsl"
#include "graphics/shading/surface.glsl"
#include "graphics/shading/glass.glsl"
#include "reflections/reflector_maps/patch_uniforms.glsl"
#include "reflections/refraction/glass_rays.glsl"

#include "reflections/reflector_maps/patch_view_block.glsl"
#include "reflections/refraction/glass_light_block.glsl"

uniform samplerCube surroundings;

in vec3 at_reflector;
out vec4 radiance;

#include "reflections/refraction/glass_light_part.glsl"
const int inner_bounces = 3;

vec3 light_from(vec3 place, vec3 direction) {
  vec3 d = normalize(mat3(world_from_reflector) * direction);
  vec3 around = cube_map_radiance(surroundings, max(surroundings_levels, 0.0f), d, 0.0f);
  if (surroundings_levels >= 0.0f) return around;
  return sky_share_of_direction(sky_visibility_cell(moved(world_from_reflector, place), d), d) *
         sky_radiance(d, 0.0f);
}

void main() {
  SurfacePoint at = surface_at(at_reflector - map_centre);
  vec3 position = at.position;
  float glass_ior = glass_absorption.w;
  vec3 direction = refracted(normalize(at_reflector - viewer_in_reflector.xyz), at.normal, 1.0f / glass_ior);
  vec3 share = vec3(1.0f), behind = vec3(0.0f), let = vec3(0.0f), inside = vec3(0.0f);
  for (int bounce = 0; bounce <= inner_bounces; ++bounce) {
    SurfacePoint exit = far_side(map_centre, map_size.z, position, direction);
    share *= exp(-distance(exit.position, position) * glass_absorption.rgb);
    vec3 out_way = refracted(direction, -exit.normal, glass_ior);
    bool leaves = dot(out_way, out_way) > 0.0f;
    float kept = leaves ? inner_reflectance(glass_ior, dot(out_way, exit.normal)) : 1.0f;
    if (bounce == inner_bounces) kept = 0.0f;  // what still goes round is let out
    vec3 light = light_from(exit.position, leaves ? out_way : direction);
    vec3 out_share = (1.0f - kept) * share;
    if (bounce == 0) {
      behind = light;
      let = out_share;
    } else {
      inside += out_share * light;
    }
    share *= kept;
    direction = reflect(direction, exit.normal);
    position = exit.position;
  }
  if (shown_part == behind_glass)
    radiance = vec4(behind, 1.0f);
  else if (shown_part == let_through)
    radiance = vec4(let, 1.0f);
  else if (shown_part == from_inside)
    radiance = vec4(inside, 1.0f);
  else
    radiance = vec4(let * behind + inside, 1.0f);
}
