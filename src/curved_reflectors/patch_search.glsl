// The search over one patch of a reflector: Newton's method from the best of some places spread over the patch (for a body that is
// one patch, from where a ball would reflect), then without the belief that the way is shortest there (patches are convex or
// concave as a whole, not everywhere), then from the next best. From the host:
//   SurfacePoint search_start(int i)    places spread over the patch
//   float surface_kind(vec3 direction)  see reflector_map.glsl
// Needs newton_search.glsl and map_window.glsl.

const int search_start_count = 16;
const int best_start_count = 4;
const int layer_count = search_start_count + 1;
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

// Hollows and saddles may show a vertex several times. A layer holds for each vertex the point that is found from one place, the
// same for all, so that the corners of a triangle end in the same image of it; the last layer begins below the vertex, where the
// points of what nearly touches a hollow are. `layer` -1: the patch shows a vertex once.
GLSL_FUNCTION PatchPoint search_patch(ReflectionTask task, bool is_convex, bool is_whole_body, int layer) {
  PatchPoint best;
  best.point.angle = 4.0f;
  if (is_whole_body || layer >= 0) {
    vec3 start = layer < 0 ? first_direction(task) : task.vertex - task.centre;
    if (layer >= 0 && layer < search_start_count) start = search_start(layer).position - task.centre;
    best = patch_point(task, start, is_convex && layer < 0);
    if (layer >= 0 || ends_search(best)) return best;
  }
  vec3 starts[4];  // best_start_count, the best first
  float errors[4];
  for (int k = 0; k < best_start_count; ++k) {
    starts[k] = search_start(0).position - task.centre;
    errors[k] = 2.0f;
  }
  for (int i = 0; i < search_start_count; ++i) {
    SurfacePoint at = search_start(i);
    vec3 start = at.position - task.centre;
    float error = bisector_error(bisector(task.viewer, task.vertex, at), at.normal);
    for (int k = 0; k < best_start_count; ++k) {
      if (error >= errors[k]) continue;
      vec3 moved = starts[k];  // it and all behind it make place
      float moved_error = errors[k];
      starts[k] = start;
      errors[k] = error;
      start = moved;
      error = moved_error;
    }
  }
  for (int k = 0; k < best_start_count; ++k)
    for (int belief = is_convex && k < 2 ? 1 : 0; belief >= 0; --belief) {
      PatchPoint other = patch_point(task, starts[k], belief == 1);
      if (ends_search(other)) return other;
      if (other.point.angle < best.point.angle) best = other;
    }
  return best;
}
