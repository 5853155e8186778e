// Reflection point by Fermat's principle: the length |OP| + |PV| of the path from the viewer O over the surface point P to the
// vertex V is stationary. Newton's method in the tangent plane of P:
//   step = -H^-1 g,   g: gradient of the length,   H = H_plane + (cos(O) + cos(V)) B
// The second derivatives H_plane over a plane are exact; the curvature B of the surface is measured (surface_bend.glsl).
// Steps are limited to a trust region, which shrinks when one fails; on bands and concave patches B is then measured again.
// After two failures the step follows the negative gradient, the paper's direction. Along a thin rim the length is a narrow
// valley in which every step increases the error a little: a step is accepted there, too, if the Newton step that remains,
// with the derivatives at the step's start, is shorter than before (natural monotonicity test, Deuflhard 1974).
// Hidden vertices need no special case: a vertex and its mirror image have the same tangential component.
// Required from the host, beside surface_at:
//   MapWindow map_window()   the part of the sphere of directions in which the centre sees the reflector
// Needs reflection_point.glsl and map_window.glsl.
#include "reflections/reflection_search/surface_bend.glsl"

const float first_region = 0.25f;      // maximum first step: radians seen from the centre; on bands also radians of the normal
const float min_curvature = 1e-3f;     // of the length over a convex reflector, relative to its maximum curvature
const float near_error = 2e-7f;        // 0.05 degrees
const float near_step = 2e-3f;         // relative to the distance from the centre: about a texel of a whole body's map
const float seen_error = 0.25f;        // 60 degrees; with a larger error the viewer may see the surface's back

// Maximum growth of the error per step. Error valleys are curved, so allowing a small increase finds more reflection points, at the
// price of neighbouring vertices converging to different ones.
const float free_growth = 1.1f;
const float steady_growth = 0.95f;

// Starting point of searches.
struct SearchStart {
  TangentPlane plane;
  vec3 bend;  // curvature of the surface, measured about half as far as the next starting point
};

// State of the search: a surface point, its tangent plane, and the path over it.
struct Way {
  TangentPlane plane;
  vec2 slope;   // gradient of the path's length
  vec3 bend;    // second derivatives of the length over a plane: uu, uv, vv
  float lift;   // factor of the surface's own curvature: the sum of both cosines
  float length_m;
  float error;
};

// Error of equation 1, from the sum of the two unit directions: its component in the tangent plane and its height above it.
GLSL_FUNCTION float leaning_error(vec2 slope, float height) {
  float across = dot(slope, slope), size = sqrt(across + height * height);
  if (size < 1e-6f) return 1.0f;
  return height > 0.0f ? 0.5f * across / (size * (size + height)) : 0.5f * (size - height) / size;
}

GLSL_FUNCTION Way way_over(ReflectionTask task, TangentPlane plane) {
  Way way;
  way.plane = plane;
  vec3 to_viewer = task.viewer - plane.at.position, to_vertex = task.vertex - plane.at.position;
  float viewer_m = max(length(to_viewer), 1e-12f), vertex_m = max(length(to_vertex), 1e-12f);
  float viewer_bend = 1.0f / viewer_m, vertex_bend = 1.0f / vertex_m;
  to_viewer *= viewer_bend;
  to_vertex *= vertex_bend;
  vec2 a = in_tangent_plane(plane, to_viewer), b = in_tangent_plane(plane, to_vertex);
  float viewer_height = dot(to_viewer, plane.at.normal), vertex_height = dot(to_vertex, plane.at.normal);
  way.slope = -(a + b);
  way.bend = vec3(viewer_bend * (1.0f - a.x * a.x) + vertex_bend * (1.0f - b.x * b.x),
                  -viewer_bend * a.x * a.y - vertex_bend * b.x * b.y,
                  viewer_bend * (1.0f - a.y * a.y) + vertex_bend * (1.0f - b.y * b.y));
  way.lift = viewer_height + vertex_height;
  way.length_m = viewer_m + vertex_m;
  way.error = leaning_error(way.slope, viewer_height + abs(vertex_height));  // hidden vertices: seen_vertex
  return way;
}

// The path over the surface point along `direction` from the centre; `u`: approximate direction of the tangent frame's first axis.
GLSL_FUNCTION Way way_at(ReflectionTask task, vec3 direction, vec3 u) {
  return way_over(task, tangent_plane(surface_at(direction), window_frame(map_window(), direction, u)));
}

// Newton's step, to where the gradient vanishes. Over a convex reflector H is made positive definite: the length has a minimum.
GLSL_FUNCTION vec2 newton_step(Way way, vec3 surface, bool is_convex) {
  vec3 bend = way.bend + way.lift * surface;
  float middle = 0.5f * (bend.x + bend.z);
  float spread = sqrt(0.25f * (bend.x - bend.z) * (bend.x - bend.z) + bend.y * bend.y);
  if (is_convex) {
    float least = min_curvature * (abs(middle) + spread);
    float shift = max(least - (middle - spread), 0.0f);
    bend += vec3(shift, 0.0f, shift);
  }
  float determinant = bend.x * bend.z - bend.y * bend.y;
  float size = abs(middle) + spread;
  if (abs(determinant) < 1e-6f * size * size) return -way.slope / max(size, 1e-12f);
  return vec2(way.slope.y * bend.y - way.slope.x * bend.z, way.slope.x * bend.y - way.slope.y * bend.x) / determinant;
}

// Length of the Newton step for another gradient with the same second derivatives.
GLSL_FUNCTION float way_to_go(Way way, vec2 slope, vec3 surface, bool is_convex) {
  way.slope = slope;
  return length(newton_step(way, surface, is_convex));
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

// Near the reflection point the last step needs no lookup: the curvature predicts the surface there.
GLSL_FUNCTION SearchEnd search_from(ReflectionTask task, SearchStart start, SearchBounds bounds) {
  Way way = way_over(task, start.plane);
  vec3 surface = start.bend;
  bool is_convex = bounds.is_convex;
  float breadth = window_breadth(map_window());
#ifdef ALL_PLAIN
  const int hard = 0;
#else
  int hard = is_convex ? band_count(map_window()) : 1;
#endif
  float region = first_region;
  int failures = 0, failures_left = bounds.max_failures;
  vec2 last = vec2(0.0f);
  for (int i = 0; i < bounds.max_steps && failures_left > 0 && way.error >= bounds.min_error; ++i) {
    vec2 whole = newton_step(way, surface, is_convex);
    float to_go = length(whole);
    if (way.error < near_error && to_go < near_step * breadth * length(way.plane.at.position - task.centre)) {
      last = whole;
      break;
    }
    if (failures >= 2) whole = -way.slope / max(way.bend.x + way.bend.z + abs(way.lift) * length(surface), 1e-12f);
    vec3 from_centre = way.plane.at.position - task.centre;
    float size = length(whole) / length(from_centre);
    for (int bands = band_count(map_window()); bands > 0; --bands) size = max(size, length(times(surface, whole)));
    float part = min(1.0f, region / max(size, 1e-12f));
    vec2 d = part * whole;
    Way next = way_at(task, window_step(map_window(), from_centre, d.x * way.plane.u + d.y * way.plane.v), way.plane.u);
    bool is_shorter = is_convex && way.length_m - next.length_m > -0.1f * dot(way.slope, d);
    float growth = bounds.max_growth;
    bool is_nearer = false;
    for (int bands = band_count(map_window()); bands > 0; --bands) {
      growth = mix(1.0f, bounds.max_growth, part);
      is_nearer = way_to_go(way, next.slope, surface, is_convex) < (1.0f - 0.25f * part) * to_go;
    }
    bool is_better = next.error < growth * way.error ||
                     ((is_shorter || is_nearer) && next.error < seen_error);
    if (bounds.stays_on_surface && next.plane.at.kind == kind_closed) is_better = false;
    vec3 moved = next.plane.at.position - way.plane.at.position;
    surface = bend_after_step(surface, in_tangent_plane(way.plane, moved), in_tangent_plane(way.plane, next.plane.at.normal));
    if (is_better) {
      region = max(region, 2.0f * part * size);
      failures = 0;
      way = next;
    } else {
      region = 0.3f * part * size;
      failures += 1;
      failures_left -= 1;
    }
    for (int probes = is_better ? 0 : hard; probes > 0; --probes) surface = surface_bend(way.plane, task.centre, breadth);
  }
  vec2 turn = times(surface, last);
  vec3 position = on_tangent_plane(way.plane, last);
  SurfacePoint at = way.plane.at;
  at.position = position;
  at.normal = normalize(at.normal + turn.x * way.plane.u + turn.y * way.plane.v);
  return SearchEnd(PatchPoint(reflection_point(at, normalize(position - task.centre), way.error), at.kind),
                   SearchStart(way.plane, surface));
}

// Starting point where a ray from the centre hits the surface.
GLSL_FUNCTION SearchStart start_along(ReflectionTask task, vec3 direction) {
  TangentPlane plane = tangent_plane(surface_at(direction), window_frame(map_window(), direction, vec3(0.0f)));
  return SearchStart(plane, surface_bend(plane, task.centre, window_breadth(map_window())));
}

GLSL_FUNCTION ReflectionPoint search_by_newton(ReflectionTask task, vec3 start, bool is_convex, float max_growth,
                                               int max_steps, float min_error) {
  SearchBounds bounds = SearchBounds(is_convex, max_growth, max_steps, max_steps, min_error, false);
  return search_from(task, start_along(task, start), bounds).found.point;
}
