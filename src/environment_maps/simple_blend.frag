// Mirror-like surfaces that look two reference maps up by the direction alone.
#include "render/sky_lookup.glsl"
#include "environment_maps/octahedral.glsl"
#include "environment_maps/simple_blend.glsl"
#include "render/surface_body.glsl"

vec3 reflected_radiance(vec3 at, vec3 direction, float roughness) { return simple_blend(direction, roughness); }
