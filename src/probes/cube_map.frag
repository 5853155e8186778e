// Mirror-like surfaces that look their surroundings up in a cube map, as if it were infinitely far or the inside of a box.
#include "render/sky_lookup.glsl"
#include "probes/box_projection.glsl"
#include "render/surface_body.glsl"

uniform samplerCube reflection_map;
uniform float reflection_levels;
uniform float box_is_used;
uniform vec3 map_centre;
uniform vec3 box_centre;
uniform vec3 box_half_size;
uniform vec2 box_heading;  // cosine and sine

vec3 reflected_radiance(vec3 at, vec3 direction, float roughness) {
  vec3 d = direction;
  if (box_is_used > 0.5f)
    d = box_projected_direction(at, direction, map_centre, box_centre, box_half_size, box_heading);
  // The bias adds to the level that the curvature of the body calls for; half a level less keeps edges as sharp as many
  // rays a pixel show them.
  return texture(reflection_map, d, roughness * reflection_levels * 0.8f - 0.5f).rgb;
}
