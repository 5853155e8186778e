// The search over one patch of a reflector: Newton's method from where a ball of the patch's size would reflect; where that does
// not find the point, from the best of some places spread over the patch, and at last without the belief that the way is
// shortest there (patches are convex or concave as a whole, not everywhere). From the host:
//   SurfacePoint search_start(int i)    places spread over the patch
//   float surface_kind(vec3 direction)  see reflector_map.glsl
// Needs reflection_point.glsl, newton_search.glsl and reflector_map.glsl.

const int search_start_count = 16;
const int newton_steps = 12;
const float found_error = 2e-9f;    // 0.005 degrees: a search ends
const float found_angle = 0.0035f;  // radians, 0.2 degrees: beyond it a point is none

struct PatchPoint {
  ReflectionPoint point;
  float kind;
};

// May it be drawn? Else it has been told, and an environment map stands in.
GLSL_FUNCTION bool is_found(PatchPoint p) { return p.point.angle < found_angle && p.kind == kind_surface; }

GLSL_FUNCTION bool ends_search(PatchPoint p) { return p.point.angle < found_angle && p.kind != kind_closed; }

GLSL_FUNCTION PatchPoint patch_point(ReflectionTask task, vec3 start, bool is_convex) {
  ReflectionPoint point = search_by_newton(task, start, is_convex, newton_steps, found_error);
  return PatchPoint(point, surface_kind(point.direction));
}

GLSL_FUNCTION PatchPoint search_patch(ReflectionTask task, bool is_convex) {
  PatchPoint best = patch_point(task, is_convex ? first_direction(task) : search_start(0).position - task.centre, is_convex);
  if (ends_search(best)) return best;
  vec3 nearest = vec3(0.0f), second = vec3(0.0f);
  float nearest_error = 2.0f, second_error = 2.0f;
  for (int i = 0; i < search_start_count; ++i) {
    SurfacePoint at = search_start(i);
    float error = bisector_error(bisector(task.viewer, task.vertex, at), at.normal);
    if (error < nearest_error) {
      second = nearest;
      second_error = nearest_error;
      nearest = at.position;
      nearest_error = error;
    } else if (error < second_error) {
      second = at.position;
      second_error = error;
    }
  }
  for (int attempt = 0; attempt < 4; ++attempt) {
    vec3 from = attempt % 2 == 0 ? nearest : second;
    PatchPoint other = patch_point(task, from - task.centre, is_convex && attempt < 2);
    if (ends_search(other)) return other;
    if (other.point.angle < best.point.angle) best = other;
  }
  return best;
}
