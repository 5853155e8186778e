// The mirror rays of surfaces, for methods that evaluate each pixel's reflection once: where a ray leaves
// (xyz; w: roughness of the base) and its direction (xy: octahedral; z: roughness of the coat; w: the
// object's index and 1). HAS_RAYS: only of those surfaces that no ray of the first layer fits.
#define WRITES_SURFACE
#include "graphics/render/surface_body.glsl"
#include "graphics/shading/octahedral.glsl"
#ifdef HAS_RAYS
#include "reflections/methods/fitting_ray.glsl"
#endif

layout(location = 0) out vec4 ray_start;
layout(location = 1) out vec4 ray_way;

void write_surface(Surface surface, vec3 to_viewer) {
  vec3 direction = reflect(-to_viewer, surface.normal);
#ifdef HAS_RAYS
  float footprint_m = max(length(dFdx(position)) + length(dFdy(position)), 1e-4f), least;
  fitting_pixel(position, direction, footprint_m, least);
  if (least <= 1.0f) discard;
#endif
  ray_start = vec4(position, surface.roughness);
  ray_way = vec4(octahedral_uv(direction), surface.clear_coat_roughness, float(surface_object() + 1));
}
