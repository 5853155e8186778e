// Where a patch of a reflector shows each vertex of the scene (Estalella and others 2005, sections 3, 4 and 6.1): the search
// finds the reflection point, and the vertex stands behind it as behind the plane that touches there.
#include "render/surface_vertex.glsl"
#include "curved_reflectors/patch_uniforms.glsl"
#include "curved_reflectors/newton_search.glsl"
#include "curved_reflectors/patch_search.glsl"

out vec3 seen_from;
out float is_lost;
out vec3 shown_by;
out float height;

void main() {
  surface_vertex();
  ReflectionTask task =
      ReflectionTask(moved(reflector_from_world, viewer_position.xyz), moved(reflector_from_world, position), map_centre);
  PatchKind kind = PatchKind(patch_kind.x > 0.5f, patch_kind.y > 0.5f, patch_layer < 0);
  PatchPoint found = search_patch(task, kind, patch_layer);
  // Points beyond a rim are no reflections, but corners of triangles that reach over it. What closes a hollow lies between it
  // and the viewer: there they are not even that.
  bool has_place = found.kind == kind_surface || (found.kind == kind_closed && kind.is_convex);
  is_lost = found.point.angle < found_angle && has_place ? 0.0f : 1.0f;
  height = dot(task.vertex - found.point.position, found.point.normal);
  shown_by = found.point.normal;
  seen_from = moved(world_from_reflector, found.point.position);
  vec3 image = virtual_vertex(task.vertex, found.point.position, found.point.normal);
  if (is_lost > 0.0f) image = map_centre;  // finite; the triangle is not drawn
  gl_Position = clip_from_world * vec4(moved(world_from_reflector, image), 1.0f);
}
