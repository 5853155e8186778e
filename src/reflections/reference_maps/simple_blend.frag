// Mirror-like surfaces that look two reference maps up by the direction alone.
#include "graphics/render/sky_lookup.glsl"
#include "graphics/shading/octahedral.glsl"
#include "reflections/reference_maps/simple_blend.glsl"
#include "graphics/render/mirrored_direction.glsl"
#include "graphics/render/surface_body.glsl"

vec3 reflected_radiance(float roughness, int layer) { return simple_blend(mirrored_direction, roughness); }
