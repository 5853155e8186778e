// The search over one patch of a reflector: Newton's method from the best of some places spread over the patch (for a body that is
// one patch, from where a ball would reflect), then without the belief that the way is shortest there (patches are convex or
// concave as a whole, not everywhere), then from the next best. From the host:
//   SurfacePoint search_start(int i)    places spread over the patch
//   float surface_kind(vec3 direction)  see reflector_map.glsl
// Needs newton_search.glsl and map_window.glsl.

const int search_start_count = 16;
const int layer_count = search_start_count + 1;
const int best_start_count = 6;  // tried where there is one point at most
const int believing_starts = 6;
const int newton_steps = 20;
const float found_error = 2e-9f;    // 0.005 degrees: a search ends
const float found_angle = 0.0035f;  // radians, 0.2 degrees: beyond it a point is none

struct PatchKind {
  bool is_convex;      // else the surface bends toward the side that it reflects
  bool is_whole_body;  // its centre sees surface all around
  bool shows_once;     // hardly anywhere a saddle: a vertex has one image at most
};

struct PatchPoint {
  ReflectionPoint point;
  float kind;
};

// May it be drawn? Else it has been told, and an environment map stands in.
GLSL_FUNCTION bool is_found(PatchPoint p) { return p.point.angle < found_angle && p.kind == kind_surface; }

GLSL_FUNCTION PatchPoint patch_point(ReflectionTask task, vec3 start, bool is_convex, float most_growth) {
  ReflectionPoint point = search_by_newton(task, start, is_convex, most_growth, newton_steps, found_error);
  return PatchPoint(point, surface_kind(point.direction));
}

// Hollows and saddles may show a vertex several times. A layer holds for each vertex the point that is found from one place, the
// same for all, so that the corners of a triangle end in the same image of it; the last layer begins below the vertex, where the
// points of what nearly touches a hollow are. `layer` -1: any point will do.
GLSL_FUNCTION PatchPoint search_patch(ReflectionTask task, PatchKind kind, int layer) {
  PatchPoint best;
  best.point.angle = 4.0f;
  if (kind.is_whole_body || layer >= 0) {
    vec3 start = layer < 0 ? first_direction(task) : task.vertex - task.centre;
    if (layer >= 0 && layer < search_start_count) start = search_start(layer).position - task.centre;
    best = patch_point(task, start, kind.is_convex && layer < 0, layer < 0 ? free_growth : steady_growth);
    if (layer >= 0 || is_found(best)) return best;
  }
  float errors[16];  // search_start_count
  for (int i = 0; i < search_start_count; ++i) {
    SurfacePoint at = search_start(i);
    errors[i] = bisector_error(bisector(task.viewer, task.vertex, at), at.normal);
  }
  int attempts = kind.shows_once ? best_start_count : layer_count;
  for (int k = 0; k < attempts; ++k) {
    int next = 0;
    for (int i = 1; i < search_start_count; ++i) next = errors[i] < errors[next] ? i : next;
    errors[next] = 2.0f;  // more than any
    vec3 start = (k < search_start_count ? search_start(next).position : task.vertex) - task.centre;
    for (int belief = kind.is_convex && k < believing_starts ? 1 : 0; belief >= 0; --belief) {
      PatchPoint other = patch_point(task, start, belief == 1, free_growth);
      if (is_found(other)) return other;
      if (other.point.angle < best.point.angle) best = other;
    }
  }
  return best;
}
