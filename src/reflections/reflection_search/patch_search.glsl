// The search over one patch of a reflector, by Newton's method from places spread over the patch, about each of which it is known
// beforehand how the surface bends: first from that of the few from which it has the shortest way to go, then from those of many.
// Each begins with a belief about whether the way is shortest at the point (patches are convex or concave as a whole, not
// everywhere), and has a second turn with the other. They keep to the surface, and where all have failed one goes on beyond its rim,
// where corners of triangles lie that reach over it. From the host:
//   SearchStart search_start(int i)    a place; those of a layer first
//   SearchStart further_start(int i)   the same, and all further ones
// Needs newton_search.glsl and map_window.glsl.

const int search_start_count = 16;
const int starts_beside = 8;       // each of those
const int all_start_count = 144;
const int layer_count = search_start_count + 1;
const int max_attempts = 16;
const int newton_steps = 20;
const int max_failures = 4;
const float found_error = 2e-9f;    // 0.005 degrees: a search ends
const float found_angle = 0.0035f;  // radians, 0.2 degrees: beyond it a point is none
const float second_turn = 16.0f;    // as if the way were so much longer, squared
const float no_turn = 1e12f;

struct PatchKind {
  bool is_convex;      // else the surface bends toward the side that it reflects
  bool is_whole_body;  // its centre sees surface all around
};

// True if the search converged on the surface. Otherwise the vertex is flagged and the environment map is shown instead.
GLSL_FUNCTION bool is_found(PatchPoint p) { return p.point.angle < found_angle && p.kind == kind_surface; }

// From near a point of about the same task, over rims where they are in its way.
GLSL_FUNCTION PatchPoint patch_point(ReflectionTask task, vec3 start, bool is_convex, float max_growth) {
  SearchBounds bounds = SearchBounds(is_convex, max_growth, newton_steps, newton_steps, found_error, false);
  return search_from(task, start_along(task, start), bounds).found;
}

// About what Newton's method has to go from a start, squared, for its distance from the centre.
GLSL_FUNCTION float way_from_start(ReflectionTask task, SearchStart start, bool is_convex) {
  vec3 position = start.plane.at.position, from_centre = position - task.centre;
  vec3 to_viewer = task.viewer - position, to_vertex = task.vertex - position;
  float viewer_bend = inversesqrt(dot(to_viewer, to_viewer)), vertex_bend = inversesqrt(dot(to_vertex, to_vertex));
  vec3 sum = viewer_bend * to_viewer + vertex_bend * to_vertex;
  vec2 lean = in_tangent_plane(start.plane, sum);
  float lift = dot(sum, start.plane.at.normal), flat_bend = viewer_bend + vertex_bend;
  float below = min(vertex_bend * dot(to_vertex, start.plane.at.normal), 0.0f), height = lift - 2.0f * below;  // seen_vertex
  vec3 bend = vec3(flat_bend, 0.0f, flat_bend) + lift * start.bend;
  vec2 turned = vec2(lean.x * bend.z - lean.y * bend.y, lean.y * bend.x - lean.x * bend.y);
  float determinant = bend.x * bend.z - bend.y * bend.y;
  float to_go = dot(turned, turned) / max(determinant * determinant, 1e-20f);
  to_go *= is_convex && min(determinant, bend.x) <= 0.0f ? 4.0f : 1.0f;
  to_go *= dot(lean, lean) > 3.0f * height * abs(height) ? 1e3f : 1.0f;  // seen_error
  return max(to_go / dot(from_centre, from_centre), 1e-12f);
}

// Does the way bend upward everywhere about a start, as at a point of a convex surface? At what the viewer does not see nothing is
// known of that.
GLSL_FUNCTION bool bends_upward(ReflectionTask task, SearchStart start) {
  Way way = way_over(task, start.plane);
  vec3 bend = way.bend + way.lift * start.bend;
  return way.lift <= 0.0f || (bend.x > 0.0f && bend.x * bend.z > bend.y * bend.y);
}

// Concave surfaces and saddles may show a vertex several times. A layer holds for each vertex the point that is found from one place, the
// same for all, so that the corners of a triangle end in the same image of it; the last layer begins below the vertex, where the
// points of objects that nearly touch a concave surface are. `layer` -1: any point will do.
GLSL_FUNCTION PatchPoint search_patch(ReflectionTask task, PatchKind kind, int layer) {
#ifndef ALL_PLAIN
  if (layer >= 0) {
    SearchBounds bounds = SearchBounds(false, steady_growth, newton_steps, newton_steps, found_error, false);
    if (layer < search_start_count) return search_from(task, search_start(layer), bounds).found;
    return search_from(task, start_along(task, task.vertex - task.centre), bounds).found;
  }
#endif
  float to_go[144];  // all_start_count; below 0 where there was a first turn
  int next = 0;
  float least = no_turn;
  for (int i = 0; i < search_start_count; ++i) to_go[i] = way_from_start(task, search_start(i), kind.is_convex);
  for (int i = 0; i < search_start_count; ++i) {
    next = to_go[i] < least ? i : next;
    least = min(to_go[i], least);
  }
  int first = search_start_count + starts_beside * next, last = first + starts_beside;
  for (int i = first; i < last; ++i) to_go[i] = way_from_start(task, further_start(i), kind.is_convex);
  for (int i = first; i < last; ++i) {
    next = to_go[i] < least ? i : next;
    least = min(to_go[i], least);
  }
  SearchEnd best;
  best.found.point.angle = 4.0f;
  bool is_done = false;
  for (int k = 0; k <= max_attempts && !is_done; ++k) {
    SearchStart start = further_start(next);
    bool had_turn = to_go[next] < 0.0f, is_last = k == max_attempts;
    to_go[next] = had_turn || !kind.is_convex ? no_turn : -to_go[next];
    bool is_convex = kind.is_convex && (is_last || bends_upward(task, start) != had_turn);
    if (is_last) start = best.last;
    SearchEnd end =
        search_from(task, start, SearchBounds(is_convex, free_growth, newton_steps, is_last ? newton_steps : max_failures,
                                              found_error, !is_last));
    is_done = is_found(end.found);
    if (is_done || end.found.point.angle < best.found.point.angle) best = end;
    float turn = to_go[next];
    int unknown = k == 0 && !is_done ? search_start_count : all_start_count;
    for (int i = unknown; i < all_start_count; ++i) to_go[i] = way_from_start(task, further_start(i), kind.is_convex);
    to_go[next] = turn;
    least = no_turn;
    for (int i = 0; i < all_start_count && !is_done; ++i) {
      float rank = to_go[i] < 0.0f ? -second_turn * to_go[i] : to_go[i];
      next = rank < least ? i : next;
      least = min(rank, least);
    }
  }
  return best.found;
}
