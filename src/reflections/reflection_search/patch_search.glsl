// Search over one patch of a reflector by Newton's method, from starting points spread over the patch at
// which the curvature is known beforehand. First among a few of them, then among many, the one with the
// shortest estimated Newton step is tried. Each try assumes that the path's length has a minimum at the
// reflection point or that it has none (patches are convex or concave as a whole, not everywhere), and a
// second try assumes the opposite. These searches stay on the surface; if all fail, one continues beyond the
// patch's rim, where corners of triangles that reach over it lie. Required from the host:
//   SearchStart search_start(int i)    the few starting points; those of the layers
//   SearchStart further_start(int i)   the same, followed by all others
// Needs newton_search.glsl, map_window.glsl and search_limits.glsl.

const int layer_count = search_start_count + 1;
const int max_attempts = 16;
const int newton_steps = 20;
const int max_failures = 4;
const float found_error = 2e-9f;  // 0.005 degrees: termination
const float second_turn = 16.0f;  // penalty of the opposite assumption: factor of the squared step
const float no_turn = 1e12f;

struct PatchKind {
  bool is_convex;      // else concave
  bool is_whole_body;  // its centre sees surface all around
};

// True if the search converged on the surface. Otherwise the vertex is flagged and the environment map is
// shown instead.
GLSL_FUNCTION bool is_found(PatchPoint p) { return p.point.angle < found_angle && p.kind == kind_surface; }

// Search from a point of a similar task; it may pass beyond rims.
GLSL_FUNCTION PatchPoint patch_point(ReflectionTask task, vec3 start, bool is_convex, float max_growth) {
  SearchBounds bounds = SearchBounds(is_convex, max_growth, newton_steps, newton_steps, found_error, false);
  return search_from(task, start_along(task, start), bounds).found;
}

// Estimated Newton step from a starting point, relative to its distance from the centre, squared.
GLSL_FUNCTION float estimated_step(ReflectionTask task, SearchStart start, bool is_convex) {
  vec3 position = start.plane.at.position, from_centre = position - task.centre;
  vec3 to_viewer = task.viewer - position, to_vertex = task.vertex - position;
  float per_viewer_m = inversesqrt(dot(to_viewer, to_viewer)),
        per_vertex_m = inversesqrt(dot(to_vertex, to_vertex));
  vec3 sum = per_viewer_m * to_viewer + per_vertex_m * to_vertex;
  vec2 lean = in_tangent_plane(start.plane, sum);
  float cosine_sum = dot(sum, start.plane.at.normal), plane_curvature = per_viewer_m + per_vertex_m;
  float below = min(per_vertex_m * dot(to_vertex, start.plane.at.normal), 0.0f),
        height = cosine_sum - 2.0f * below;  // seen_vertex
  vec3 h = vec3(plane_curvature, 0.0f, plane_curvature) + cosine_sum * start.curvature;
  vec2 turned = vec2(lean.x * h.z - lean.y * h.y, lean.y * h.x - lean.x * h.y);
  float determinant = h.x * h.z - h.y * h.y;
  float squared_steps = dot(turned, turned) / max(determinant * determinant, 1e-20f);
  squared_steps *= is_convex && min(determinant, h.x) <= 0.0f ? 4.0f : 1.0f;
  squared_steps *= dot(lean, lean) > 3.0f * height * abs(height) ? 1e3f : 1.0f;  // seen_error
  return max(squared_steps / dot(from_centre, from_centre), 1e-12f);
}

// True if the path's length is convex about a starting point, as over a convex surface, or if the viewer does
// not see the point.
GLSL_FUNCTION bool has_minimum(ReflectionTask task, SearchStart start) {
  PathState path = path_over(task, start.plane);
  vec3 h = path.plane_hessian + path.cosine_sum * start.curvature;
  return path.cosine_sum <= 0.0f || (h.x > 0.0f && h.x * h.z > h.y * h.y);
}

// Concave surfaces and saddles may show a vertex several times. A layer holds for each vertex the point found
// from one starting point, the same for all vertices, so that the corners of a triangle converge to the same
// image of it; the last layer starts below the vertex, where the reflection points of objects that nearly
// touch a concave surface lie. `layer` -1: any reflection point.
GLSL_FUNCTION PatchPoint search_patch(ReflectionTask task, PatchKind kind, int layer) {
#ifndef ALL_PLAIN
  if (layer >= 0) {
    SearchBounds bounds = SearchBounds(false, steady_growth, newton_steps, newton_steps, found_error, false);
    if (layer < search_start_count) return search_from(task, search_start(layer), bounds).found;
    return search_from(task, start_along(task, task.vertex - task.centre), bounds).found;
  }
#endif
  // The best of a few starting points, then of those beside it.
  float squared_steps[144];  // all_start_count; below 0 where there was a first turn
  int next = 0;
  float minimum = no_turn;
  for (int i = 0; i < search_start_count; ++i)
    squared_steps[i] = estimated_step(task, search_start(i), kind.is_convex);
  for (int i = 0; i < search_start_count; ++i) {
    next = squared_steps[i] < minimum ? i : next;
    minimum = min(squared_steps[i], minimum);
  }
  int first = search_start_count + starts_beside * next, last = first + starts_beside;
  for (int i = first; i < last; ++i)
    squared_steps[i] = estimated_step(task, further_start(i), kind.is_convex);
  for (int i = first; i < last; ++i) {
    next = squared_steps[i] < minimum ? i : next;
    minimum = min(squared_steps[i], minimum);
  }

  // One search after another, each from the starting point of the shortest estimated step that is left.
  SearchEnd best;
  best.found.point.angle = 4.0f;
  bool is_done = false;
  for (int k = 0; k <= max_attempts && !is_done; ++k) {
    SearchStart start = further_start(next);
    bool had_turn = squared_steps[next] < 0.0f, is_last = k == max_attempts;
    squared_steps[next] = had_turn || !kind.is_convex ? no_turn : -squared_steps[next];
    bool is_convex = kind.is_convex && (is_last || has_minimum(task, start) != had_turn);
    if (is_last) start = best.last;
    SearchEnd end = search_from(task, start,
                                SearchBounds(is_convex, free_growth, newton_steps,
                                             is_last ? newton_steps : max_failures, found_error, !is_last));
    is_done = is_found(end.found);
    if (is_done || end.found.point.angle < best.found.point.angle) best = end;

    // The next starting point; after the first failure among all of them.
    float turn = squared_steps[next];
    int unknown = k == 0 && !is_done ? search_start_count : all_start_count;
    for (int i = unknown; i < all_start_count; ++i)
      squared_steps[i] = estimated_step(task, further_start(i), kind.is_convex);
    squared_steps[next] = turn;
    minimum = no_turn;
    for (int i = 0; i < all_start_count && !is_done; ++i) {
      float rank = squared_steps[i] < 0.0f ? -second_turn * squared_steps[i] : squared_steps[i];
      next = rank < minimum ? i : next;
      minimum = min(rank, minimum);
    }
  }
  return best.found;
}
