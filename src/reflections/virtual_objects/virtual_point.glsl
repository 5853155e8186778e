// Where one mirror shows a point of the scene (Estalella and others 2005, sections 3, 4 and 6.1). All in the
// mirror's frame.
#include "reflections/reflector_maps/patch_uniforms.glsl"
#include "reflections/reflector_maps/start_rows.glsl"
#include "reflections/reflection_search/newton_search.glsl"
#include "reflections/virtual_objects/mirrored_triangle.glsl"

SearchStart search_start(int i) {
  vec3 normal = start_normals[16 * mirror + i], axis = start_axes[16 * mirror + i];
  SurfacePoint at = SurfacePoint(start_positions[16 * mirror + i], normal, kind_surface);
  return SearchStart(TangentPlane(at, axis, cross(normal, axis)), start_curvatures[16 * mirror + i]);
}

// Of the rows below the map (gpu_reflector.cpp).
vec3 start_texel(int i, int vector) {
  vec4 texel = reflector_texel(ivec2(4 * (i % starts_in_row) + vector, int(map_size.y) + i / starts_in_row));
  return texel.xyz;
}

SearchStart further_start(int i) {
  vec3 normal = start_texel(i, 1), axis = start_texel(i, 2);
  SurfacePoint at = SurfacePoint(start_texel(i, 0), normal, kind_surface);
  return SearchStart(TangentPlane(at, axis, cross(normal, axis)), start_texel(i, 3));
}

#include "reflections/reflection_search/search_limits.glsl"
#include "reflections/reflection_search/patch_search.glsl"
#include "reflections/reflection_search/midpoint_search.glsl"

const float doubtful_angle = 0.2f;  // radians

struct VirtualPoint {
  vec3 image;      // behind the surface, as behind the plane that touches there
  vec3 seen_from;  // the reflection point
  vec3 shown_by;   // the surface's normal there
  float certainty;
};

PatchKind patch_kind_of_mirror() { return PatchKind(patch_kind.x > 0.5f, patch_kind.y > 0.5f); }

#ifdef MIDPOINT_ITERATIONS
// The paper's search takes a given number of steps, and its last point is drawn. Beyond this it was on its
// way to nothing: the mirror does not show the vertex.
const float astray_angle = 0.2f;  // radians, 11 degrees
bool is_near_enough(PatchPoint found) { return found.point.angle < astray_angle; }

PatchPoint point_of_mirror(ReflectionTask task, PatchKind kind) {
  vec3 start = task.vertex - task.centre;
  if (patch_layer < search_start_count)
    start = search_start(max(patch_layer, 0)).plane.at.position - task.centre;
  if (patch_layer < 0 && kind.is_whole_body) start = first_direction(task);
  ReflectionPoint point = search_by_midpoint(task, start, MIDPOINT_ITERATIONS, found_error);
  return PatchPoint(point, surface_kind(point.direction));
}
#else
bool is_near_enough(PatchPoint found) { return found.point.angle < found_angle; }

PatchPoint point_of_mirror(ReflectionTask task, PatchKind kind) {
  return search_patch(task, kind, patch_layer);
}
#endif

// Points beyond a rim are no reflections, but corners of triangles that reach over it. What closes a concave
// surface lies between it and the viewer: there they are not even that.
bool has_place(PatchPoint found, PatchKind kind) {
  return is_near_enough(found) &&
         (found.kind == kind_surface || (found.kind == kind_closed && kind.is_convex));
}

VirtualPoint virtual_point(vec3 viewer, vec3 vertex) {
  PatchKind kind = patch_kind_of_mirror();
  PatchPoint found = point_of_mirror(ReflectionTask(viewer, vertex, map_centre), kind);
  float certainty = kind.is_convex && patch_layer < 0 && found.point.angle < doubtful_angle ? doubtful : lost;
  if (has_place(found, kind)) certainty = sure;
  vec3 image = virtual_vertex(vertex, found.point.position, found.point.normal);
  if (certainty == lost) image = map_centre;  // finite; the triangle is not drawn
  return VirtualPoint(image, found.point.position, found.point.normal, certainty);
}
