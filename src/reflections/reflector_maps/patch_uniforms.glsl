// One patch of a reflector, or one of each of two, as GpuReflector::bind hands them to shaders.
#include "graphics/shading/octahedral.glsl"
#include "reflections/reflection_search/map_window.glsl"
#include "reflections/reflection_search/surface_point.glsl"

#ifndef MIRRORS
#define MIRRORS 1
#endif

uniform highp sampler2D reflector_texels;
uniform mat4 reflectors_from_world[MIRRORS];  // turned, moved and scaled evenly
uniform mat4 world_from_reflectors[MIRRORS];
uniform vec3 map_centres[MIRRORS];
uniform vec3 map_sizes[MIRRORS];  // extent, side and reach of the window
uniform vec3 map_bands[MIRRORS];
uniform vec3 map_axes[3 * MIRRORS];
uniform vec2 patch_kinds[MIRRORS];  // convex; seen all around from the centre
uniform int
    patch_layers[MIRRORS];  // of what may show a vertex several times (patch_search.glsl); -1: it does not
uniform vec3 start_positions[16 * MIRRORS];
uniform vec3 start_normals[16 * MIRRORS];
uniform vec3 start_axes[16 * MIRRORS];
uniform vec3 start_curvatures[16 * MIRRORS];

int mirror = 0;  // that all here speaks of
#define reflector_from_world reflectors_from_world[mirror]
#define world_from_reflector world_from_reflectors[mirror]
#define map_centre map_centres[mirror]
#define map_size map_sizes[mirror]
#define patch_kind patch_kinds[mirror]
#define patch_layer patch_layers[mirror]

#if MIRRORS == 2
uniform highp sampler2D second_reflector_texels;
vec4 reflector_texel(ivec2 texel) {
  return mirror == 0 ? texelFetch(reflector_texels, texel, 0) : texelFetch(second_reflector_texels, texel, 0);
}
#else
vec4 reflector_texel(ivec2 texel) { return texelFetch(reflector_texels, texel, 0); }
#endif

#include "reflections/reflector_maps/reflector_map.glsl"

MapWindow map_window() {
  return MapWindow(map_centre, mat3(map_axes[3 * mirror], map_axes[3 * mirror + 1], map_axes[3 * mirror + 2]),
                   map_size.x, map_size.y, map_size.z, map_bands[mirror]);
}

SurfacePoint surface_at(vec3 direction) {
  vec3 unit = normalize(direction);
  MapSample met = map_sample(map_window(), unit);
  return SurfacePoint(map_centre + met.distance * unit, met.normal, met.kind);
}

float surface_kind(vec3 direction) { return map_sample(map_window(), normalize(direction)).kind; }

vec3 moved(mat4 to_from, vec3 point) {
  vec4 p = to_from * vec4(point, 1.0f);
  return p.xyz;
}

#include "reflections/reflection_search/reflection_point.glsl"

// Does the mirror show a point to a viewer about there? All in its frame.
bool is_mirrored(vec3 viewer, vec3 seen_from, vec3 point) {
  const float strayed_error = 2.5e-3f;  // 0.1 radians between bisector and normal
  SurfacePoint at = surface_at(seen_from - map_centre);
  return bisector_error(bisector(viewer, point, at), at.normal) < strayed_error;
}
