// Mirror-like surfaces that look their surroundings up in a cube map, as if it were infinitely far or the
// inside of a box.
#include "graphics/render/sky_lookup.glsl"
#include "reflections/probes/box_projection.glsl"
#include "graphics/render/surface_body.glsl"
#include "reflections/methods/cube_map_lookup.glsl"

uniform samplerCube reflection_map;
uniform float reflection_levels;
uniform float box_is_used;
uniform vec3 map_centre;
uniform vec3 box_centre;
uniform vec3 box_half_size;
uniform vec2 box_heading;  // cosine and sine

vec3 looked_up_direction;

void look_along(vec3 at, vec3 direction) {
  looked_up_direction = direction;
  if (box_is_used > 0.5f)
    looked_up_direction =
        box_projected_direction(at, direction, map_centre, box_centre, box_half_size, box_heading);
}

vec3 reflected_radiance(float roughness, int layer) {
  return cube_map_radiance(reflection_map, reflection_levels, looked_up_direction, roughness);
}
