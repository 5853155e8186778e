// Mirror-like surfaces without reflections: they shine with the mean light of the sky, as in the paper's "no
// reflection".
#include "graphics/render/sky_lookup.glsl"
#include "graphics/render/mirrored_direction.glsl"
#include "graphics/render/surface_body.glsl"

vec3 reflected_radiance(float roughness, int layer) { return sky_radiance(mirrored_direction, 1.0f); }
