// Reflection point by Fermat's principle: the length |OP| + |PV| of the path from the viewer O over the
// surface point P to the vertex V is stationary. Newton's method in the tangent plane of P:
//   step = -H^-1 g,   g: gradient of the length,   H = H_plane + (cos(O) + cos(V)) B
// The second derivatives H_plane over a plane are exact; the curvature B of the surface is measured
// (surface_curvature.glsl). Steps are limited to a trust region, which shrinks when one fails; on bands and
// concave patches B is then measured again. After two failures the step follows the negative gradient, the
// paper's direction. Along a thin rim the length is a narrow valley in which every step increases the error a
// little: a step is accepted there, too, if the Newton step that remains, with the derivatives at the step's
// start, is shorter than before (natural monotonicity test, Deuflhard 1974). Hidden vertices need no special
// case: a vertex and its mirror image have the same tangential component. Loops with at most one round stand
// in place of branches (band_count in map_window.glsl says why). Required from the host, beside surface_at:
//   MapWindow map_window()   the part of the sphere of directions in which the centre sees the reflector
// Needs reflection_point.glsl and map_window.glsl.
#include "reflections/reflection_search/surface_curvature.glsl"

const float first_region =
    0.25f;  // maximum first step: radians seen from the centre; on bands also radians of the normal
const float min_curvature =
    1e-4f;  // of the length over a convex reflector, relative to its maximum curvature; grazing sight has
            // less along it than across, by twice the cosine of incidence
const float near_error = 2e-7f;  // 0.05 degrees
const float near_step =
    2e-3f;  // relative to the distance from the centre: about a texel of a whole body's map
const float near_turn =
    2e-3f;  // radians of the normal over the step that is left: from there a small error is enough
const float seen_error = 0.25f;     // 60 degrees; with a larger error the viewer may see the surface's back
const int max_newton_failures = 2;  // then gradient descent

// Maximum growth of the error per step. Error valleys are curved, so allowing a small increase finds more
// reflection points, at the price of neighbouring vertices converging to different ones.
const float free_growth = 1.1f;
const float steady_growth = 0.95f;  // for layers, whose vertices must converge to the same image

// Starting point of searches.
struct SearchStart {
  TangentPlane plane;
  vec3 curvature;  // of the surface (uu, uv, vv), measured about half as far as the next starting point
};

// State of the search: a surface point, its tangent plane, and the path viewer - point - vertex.
struct PathState {
  TangentPlane plane;
  vec2 gradient;       // of the path's length
  vec3 plane_hessian;  // second derivatives of the length over a plane: uu, uv, vv
  float cosine_sum;    // cos(O) + cos(V): factor of the surface's curvature in the Hessian
  float length_m;
  float error;
};

// Equation 1 of Estalella, (1 - B.N) / 2, from the sum of the two unit directions, which points along the
// bisector B: its component in the tangent plane, and its height above the plane along the normal N.
GLSL_FUNCTION float equation_1_error(vec2 in_plane, float height) {
  float across = dot(in_plane, in_plane), size = sqrt(across + height * height);
  if (size < 1e-6f) return 1.0f;
  return height > 0.0f ? 0.5f * across / (size * (size + height)) : 0.5f * (size - height) / size;
}

GLSL_FUNCTION PathState path_over(ReflectionTask task, TangentPlane plane) {
  PathState path;
  path.plane = plane;
  vec3 to_viewer = task.viewer - plane.at.position, to_vertex = task.vertex - plane.at.position;
  float viewer_m = max(length(to_viewer), 1e-12f), vertex_m = max(length(to_vertex), 1e-12f);
  float per_viewer_m = 1.0f / viewer_m, per_vertex_m = 1.0f / vertex_m;
  to_viewer *= per_viewer_m;
  to_vertex *= per_vertex_m;
  vec2 a = in_tangent_plane(plane, to_viewer), b = in_tangent_plane(plane, to_vertex);
  float viewer_height = dot(to_viewer, plane.at.normal), vertex_height = dot(to_vertex, plane.at.normal);
  path.gradient = -(a + b);
  path.plane_hessian = vec3(per_viewer_m * (1.0f - a.x * a.x) + per_vertex_m * (1.0f - b.x * b.x),
                            -per_viewer_m * a.x * a.y - per_vertex_m * b.x * b.y,
                            per_viewer_m * (1.0f - a.y * a.y) + per_vertex_m * (1.0f - b.y * b.y));
  path.cosine_sum = viewer_height + vertex_height;
  path.length_m = viewer_m + vertex_m;
  path.error =
      equation_1_error(path.gradient, viewer_height + abs(vertex_height));  // hidden vertices: seen_vertex
  return path;
}

// The path over the surface point along `direction` from the centre; `u`: approximate direction of the
// tangent frame's first axis.
GLSL_FUNCTION PathState path_at(ReflectionTask task, vec3 direction, vec3 u) {
  return path_over(task, tangent_plane(surface_at(direction), window_frame(map_window(), direction, u)));
}

// Newton's step, to where the gradient vanishes. Over a convex reflector H is made positive definite: the
// length has a minimum.
GLSL_FUNCTION vec2 newton_step(PathState path, vec3 curvature, bool is_convex) {
  vec3 h = path.plane_hessian + path.cosine_sum * curvature;
  float middle = 0.5f * (h.x + h.z);
  float spread = sqrt(0.25f * (h.x - h.z) * (h.x - h.z) + h.y * h.y);  // eigenvalues: middle +- spread
  if (is_convex) {
    float min_eigenvalue = min_curvature * (abs(middle) + spread);
    float shift = max(min_eigenvalue - (middle - spread), 0.0f);
    h += vec3(shift, 0.0f, shift);
  }
  float determinant = h.x * h.z - h.y * h.y;
  float size = abs(middle) + spread;
  vec2 g = path.gradient;
  if (abs(determinant) < 1e-6f * size * size) return -g / max(size, 1e-12f);
  return vec2(g.y * h.y - g.x * h.z, g.x * h.y - g.y * h.x) / determinant;
}

// Gradient descent, the paper's direction, by about the length of a Newton step.
GLSL_FUNCTION vec2 gradient_step(PathState path, vec3 curvature) {
  return -path.gradient /
         max(path.plane_hessian.x + path.plane_hessian.z + abs(path.cosine_sum) * length(curvature), 1e-12f);
}

// Length of the Newton step for another gradient with the same second derivatives.
GLSL_FUNCTION float remaining_step(PathState path, vec2 gradient, vec3 curvature, bool is_convex) {
  path.gradient = gradient;
  return length(newton_step(path, curvature, is_convex));
}

// Termination and acceptance of steps.
struct SearchBounds {
  bool is_convex;    // assume that the length has a minimum at the reflection point
  float max_growth;  // of the error per step
  int max_steps;
  int max_failures;  // rejected steps
  float min_error;
  bool stays_on_surface;  // never passes over the surface that closes an open patch
};

struct SearchEnd {
  PatchPoint found;
  SearchStart last;  // the last point looked up, from which a search may continue
};

// Size of a step for the trust region: radians seen from the centre, and on bands also radians by which the
// normal turns.
GLSL_FUNCTION float step_size(vec2 step, vec3 from_centre, vec3 curvature) {
  float size = length(step) / length(from_centre);
  for (int bands = band_count(map_window()); bands > 0; --bands)
    size = max(size, length(times(curvature, step)));
  return size;
}

// True if a step leads closer to the reflection point. `d`: the step, `part` of the whole one, which was
// `whole_m` long.
GLSL_FUNCTION bool is_accepted(PathState path, PathState next, vec2 d, float part, float whole_m,
                               vec3 curvature, SearchBounds bounds) {
  bool is_shorter = bounds.is_convex && path.length_m - next.length_m > -0.1f * dot(path.gradient, d);
  float max_growth = bounds.max_growth;
  bool is_nearer = false;
  for (int bands = band_count(map_window()); bands > 0; --bands) {
    max_growth = mix(1.0f, bounds.max_growth, part);
    is_nearer =
        remaining_step(path, next.gradient, curvature, bounds.is_convex) < (1.0f - 0.25f * part) * whole_m;
  }
  bool is_better =
      next.error < max_growth * path.error || ((is_shorter || is_nearer) && next.error < seen_error);
  return is_better && !(bounds.stays_on_surface && next.plane.at.kind == kind_closed);
}

// The end of a search. The last step needs no lookup: the curvature predicts the surface there.
GLSL_FUNCTION SearchEnd end_of_search(ReflectionTask task, PathState path, vec2 last_step, vec3 curvature) {
  vec2 turn = times(curvature, last_step);
  vec3 position = on_tangent_plane(path.plane, last_step);
  SurfacePoint at = path.plane.at;
  at.position = position;
  at.normal = normalize(at.normal + turn.x * path.plane.u + turn.y * path.plane.v);
  return SearchEnd(PatchPoint(reflection_point(at, normalize(position - task.centre), path.error), at.kind),
                   SearchStart(path.plane, curvature));
}

// A step, shortened to the trust region.
struct TrustedStep {
  vec2 d;      // in the tangent plane, metres
  float part;  // of the whole step
  float size;  // of d, as step_size
};

GLSL_FUNCTION TrustedStep trusted_step(vec2 whole, vec3 from_centre, vec3 curvature, float region) {
  float size = step_size(whole, from_centre, curvature);
  float part = min(1.0f, region / max(size, 1e-12f));
  return TrustedStep(part * whole, part, part * size);
}

// The path over the point to which a step leads.
GLSL_FUNCTION PathState path_after(ReflectionTask task, PathState path, vec3 from_centre, vec2 d) {
  vec3 direction = window_step(map_window(), from_centre, d.x * path.plane.u + d.y * path.plane.v);
  return path_at(task, direction, path.plane.u);
}

// The trust region grows with steps that succeed, and shrinks below one that fails.
GLSL_FUNCTION float region_after(float region, TrustedStep taken, bool is_better) {
  return is_better ? max(region, 2.0f * taken.size) : 0.3f * taken.size;
}

// The curvature that both ends of a step, taken or not, show.
GLSL_FUNCTION vec3 curvature_between(PathState path, PathState next, vec3 curvature) {
  vec3 moved = next.plane.at.position - path.plane.at.position;
  return curvature_after_step(curvature, in_tangent_plane(path.plane, moved),
                              in_tangent_plane(path.plane, next.plane.at.normal));
}

// Newton's steps from a starting point, until the error is small and so is the step that remains, too many
// steps have failed, or no step is left. The error alone is not enough: beyond the point of a grazing sight
// the vertex stands for its mirror image, and the error stays at about the sight's angle to the surface
// however far the point is. Each round: the step, its length within the trust region, the path at its end,
// the curvature updated from both ends, and the decision whether the search moves there.
GLSL_FUNCTION SearchEnd search_from(ReflectionTask task, SearchStart start, SearchBounds bounds) {
  PathState path = path_over(task, start.plane);
  vec3 curvature = start.curvature;
  float breadth = window_breadth(map_window());
#ifdef ALL_PLAIN
  const int measurements = 0;
#else
  int measurements = bounds.is_convex ? band_count(map_window()) : 1;  // of the curvature after a failure
#endif
  float region = first_region;
  int failures = 0, failures_left = bounds.max_failures;
  vec2 last_step = vec2(0.0f);
  for (int i = 0; i < bounds.max_steps && failures_left > 0; ++i) {
    vec3 from_centre = path.plane.at.position - task.centre;
    vec2 whole = newton_step(path, curvature, bounds.is_convex);
    float whole_m = length(whole);
    bool is_near = path.error < near_error && whole_m < near_step * breadth * length(from_centre);
    if (is_near) last_step = whole;
    if (is_near || (path.error < bounds.min_error && length(times(curvature, whole)) < near_turn)) break;

    if (failures >= max_newton_failures) whole = gradient_step(path, curvature);
    TrustedStep tried = trusted_step(whole, from_centre, curvature, region);
    PathState next = path_after(task, path, from_centre, tried.d);
    bool is_better = is_accepted(path, next, tried.d, tried.part, whole_m, curvature, bounds);
    curvature = curvature_between(path, next, curvature);
    region = region_after(region, tried, is_better);
    failures = is_better ? 0 : failures + 1;
    failures_left -= is_better ? 0 : 1;
    if (is_better) path = next;
    for (int m = is_better ? 0 : measurements; m > 0; --m)
      curvature = surface_curvature(path.plane, task.centre, breadth);
  }
  return end_of_search(task, path, last_step, curvature);
}

// Starting point where a ray from the centre hits the surface.
GLSL_FUNCTION SearchStart start_along(ReflectionTask task, vec3 direction) {
  TangentPlane plane =
      tangent_plane(surface_at(direction), window_frame(map_window(), direction, vec3(0.0f)));
  return SearchStart(plane, surface_curvature(plane, task.centre, window_breadth(map_window())));
}

GLSL_FUNCTION ReflectionPoint search_by_newton(ReflectionTask task, vec3 start, bool is_convex,
                                               float max_growth, int max_steps, float min_error) {
  SearchBounds bounds = SearchBounds(is_convex, max_growth, max_steps, max_steps, min_error, false);
  return search_from(task, start_along(task, start), bounds).found.point;
}
