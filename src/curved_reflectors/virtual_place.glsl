// Where one mirror shows a vertex, for vertex shaders: the search, and what virtual surfaces need to know of it.
#include "curved_reflectors/patch_uniforms.glsl"
#include "curved_reflectors/newton_search.glsl"
#include "curved_reflectors/patch_search.glsl"

out vec3 seen_from;
out float is_lost;
out vec3 shown_by;
out float height;

PatchKind patch_kind_of_mirror() { return PatchKind(patch_kind.x > 0.5f, patch_kind.y > 0.5f, patch_layer < 0); }

// Points beyond a rim are no reflections, but corners of triangles that reach over it. What closes a hollow lies between it and
// the viewer: there they are not even that.
bool has_place(PatchPoint found, PatchKind kind) {
  return found.point.angle < found_angle &&
         (found.kind == kind_surface || (found.kind == kind_closed && kind.is_convex));
}

// Of a vertex in the world; the image, in the world.
vec3 virtual_place(vec3 viewer, vec3 vertex) {
  ReflectionTask task = ReflectionTask(moved(reflector_from_world, viewer), moved(reflector_from_world, vertex), map_centre);
  PatchKind kind = patch_kind_of_mirror();
  PatchPoint found = search_patch(task, kind, patch_layer);
  is_lost = has_place(found, kind) ? 0.0f : 1.0f;
  height = dot(task.vertex - found.point.position, found.point.normal);
  shown_by = found.point.normal;
  seen_from = moved(world_from_reflector, found.point.position);
  vec3 image = virtual_vertex(task.vertex, found.point.position, found.point.normal);
  if (is_lost > 0.0f) image = map_centre;  // finite; the triangle is not drawn
  return moved(world_from_reflector, image);
}
