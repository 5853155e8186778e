// Mirror-like surfaces without reflections: they shine with the mean light of the sky, as in the paper's "no reflection".
#include "render/sky_lookup.glsl"
#include "render/surface_body.glsl"

vec3 reflected_radiance(vec3 at, vec3 direction, float roughness) { return sky_radiance(direction, 1.0f); }
