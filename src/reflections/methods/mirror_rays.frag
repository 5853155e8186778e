// The mirror rays of surfaces, for methods that evaluate each pixel's reflection once: where a ray leaves
// (xyz; w: roughness of the base) and its direction (xy: octahedral; z: roughness of the coat; w: the
// object's index and 1).
#define WRITES_SURFACE
#include "graphics/render/surface_body.glsl"
#include "graphics/shading/octahedral.glsl"

layout(location = 0) out vec4 ray_start;
layout(location = 1) out vec4 ray_way;

void write_surface(Surface surface, vec3 to_viewer) {
  ray_start = vec4(position, surface.roughness);
  ray_way = vec4(octahedral_uv(reflect(-to_viewer, surface.normal)), surface.clear_coat_roughness,
                 float(surface_object() + 1));
}
