// Mirror-like surfaces that look their surroundings up in a cube map, as if it were infinitely far or the
// inside of a box; then two maps are blended (BLENDS_BOXES).
#include "graphics/render/sky_lookup.glsl"
#include "reflections/probes/box_projection.glsl"
#include "graphics/render/surface_body.glsl"
#include "reflections/methods/cube_map_lookup.glsl"

uniform samplerCube reflection_map;
uniform float reflection_levels;

#ifdef BLENDS_BOXES
uniform samplerCube second_map;
#include "reflections/probes/probe_boxes_block.glsl"

vec3 looked_up_direction[2];

void look_along(vec3 at, vec3 direction) {
  for (int i = 0; i < 2; ++i)
    looked_up_direction[i] =
        box_projected_direction(at, direction, boxes[i].map_centre.xyz, boxes[i].box_centre.xyz,
                                boxes[i].box_half_size.xyz, boxes[i].box_heading.xy);
}

vec3 reflected_radiance(float roughness, int layer) {
  return mix(cube_map_radiance(reflection_map, reflection_levels, looked_up_direction[0], roughness),
             cube_map_radiance(second_map, reflection_levels, looked_up_direction[1], roughness),
             second_share);
}
#else
#include "graphics/render/mirrored_direction.glsl"

vec3 reflected_radiance(float roughness, int layer) {
  return cube_map_radiance(reflection_map, reflection_levels, mirrored_direction, roughness);
}
#endif
