// Surfaces that mirror the sky alone: buildings, streets, trees, and movable things in views where reflections end.
#include "render/sky_lookup.glsl"
#include "render/surface_body.glsl"

vec3 reflected_radiance(vec3 at, vec3 direction, float roughness) { return sky_radiance(direction, roughness); }
