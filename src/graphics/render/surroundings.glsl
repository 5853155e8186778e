// What a place sees of the sky and of what stands before it, where no ray is traced and no map shows it.
#include "graphics/render/bounced_lookup.glsl"
#include "graphics/render/sky_lookup.glsl"

// Radiance from one direction: the sky where it is open, and what stands before it as bright as the light
// that it gives.
vec3 surroundings_radiance(vec4 sky_cell, BouncedCell bounced, vec3 direction, float roughness) {
  return sky_share_of_direction(sky_cell, direction) * sky_radiance(direction, roughness) +
         bounced_radiance(bounced, direction);
}
