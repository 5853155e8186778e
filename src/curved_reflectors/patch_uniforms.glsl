// One patch of a reflector, as GpuReflector::bind and VirtualObjects hand it to shaders.
#include "shading/octahedral.glsl"
#include "curved_reflectors/map_window.glsl"
#include "curved_reflectors/surface_point.glsl"

uniform highp sampler2D reflector_texels;
uniform mat4 reflector_from_world;  // turned, moved and scaled evenly
uniform mat4 world_from_reflector;
uniform vec3 map_centre;
uniform vec3 map_size;        // extent, side and reach of the window
uniform vec3 map_axes[3];
uniform vec2 patch_kind;      // convex; seen all around from the centre
uniform int patch_layer;      // of what may show a vertex several times (patch_search.glsl); -1: it does not
uniform vec3 start_positions[16];
uniform vec3 start_normals[16];

vec4 reflector_texel(ivec2 texel) { return texelFetch(reflector_texels, texel, 0); }

#include "curved_reflectors/reflector_map.glsl"

MapWindow map_window() {
  return MapWindow(map_centre, mat3(map_axes[0], map_axes[1], map_axes[2]), map_size.x, map_size.y, map_size.z);
}

SurfacePoint surface_at(vec3 direction) {
  vec3 unit = normalize(direction);
  MapSample met = map_sample(map_window(), unit);
  return SurfacePoint(map_centre + met.distance * unit, met.normal);
}

float surface_kind(vec3 direction) { return map_sample(map_window(), normalize(direction)).kind; }

SurfacePoint search_start(int i) { return SurfacePoint(start_positions[i], start_normals[i]); }

vec3 moved(mat4 to_from, vec3 point) {
  vec4 p = to_from * vec4(point, 1.0f);
  return p.xyz;
}

#include "curved_reflectors/reflection_point.glsl"
