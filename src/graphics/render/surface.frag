// Surfaces that mirror sky and bounced light alone: buildings, streets, trees, and movable things in views
// where reflections end. Walls that hide the sky dim its reflection.
#include "graphics/render/mirrored_direction.glsl"
#include "graphics/render/surface_body.glsl"

vec3 reflected_radiance(float roughness, int layer) {
  return unmapped_radiance(mirrored_direction, roughness);
}
