// Surfaces that mirror the sky alone: buildings, streets, trees, and movable things in views where reflections end.
// Walls that hide the sky dim its reflection.
#include "render/surface_body.glsl"

vec3 reflected_radiance(vec3 at, vec3 direction, float roughness) {
  return sky_share_of_direction(surface_sky_cell, direction) * sky_radiance(direction, roughness);
}
