// Mirror-like surfaces that look two reference maps up by the direction alone.
#include "render/sky_lookup.glsl"
#include "shading/octahedral.glsl"
#include "environment_maps/simple_blend.glsl"
#include "render/surface_body.glsl"

vec3 mirrored_direction;

void look_along(vec3 at, vec3 direction) { mirrored_direction = direction; }

vec3 reflected_radiance(float roughness, int layer) { return simple_blend(mirrored_direction, roughness); }
