// Where a patch of a reflector shows each vertex of the scene (Estalella and others 2005, sections 3, 4 and 6.1): the search
// finds the reflection point, and the vertex stands behind it as behind the plane that touches there.
#include "render/surface_vertex.glsl"
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

#include "curved_reflectors/reflection_point.glsl"
#include "curved_reflectors/newton_search.glsl"
#include "curved_reflectors/patch_search.glsl"

out vec3 seen_from;
out float is_lost;
out float height;

vec3 moved(mat4 to_from, vec3 point) {
  vec4 p = to_from * vec4(point, 1.0f);
  return p.xyz;
}

void main() {
  surface_vertex();
  ReflectionTask task =
      ReflectionTask(moved(reflector_from_world, viewer_position.xyz), moved(reflector_from_world, position), map_centre);
  bool is_convex = patch_kind.x > 0.5f;
  PatchPoint found = search_patch(task, is_convex, patch_kind.y > 0.5f);
  // Points beyond a rim are no reflections, but corners of triangles that reach over it. What closes a hollow lies between it
  // and the viewer: there they are not even that.
  bool has_place = found.kind == kind_surface || (found.kind == kind_closed && is_convex);
  is_lost = found.point.angle < found_angle && has_place ? 0.0f : 1.0f;
  height = dot(task.vertex - found.point.position, found.point.normal);
  seen_from = moved(world_from_reflector, found.point.position);
  vec3 image = virtual_vertex(task.vertex, found.point.position, found.point.normal);
  if (is_lost > 0.0f) image = map_centre;  // finite; the triangle is not drawn
  gl_Position = clip_from_world * vec4(moved(world_from_reflector, image), 1.0f);
}
