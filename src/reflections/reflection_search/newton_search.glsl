// The reflection point as the shortest way over the reflector (Fermat): where |OP| + |PV| is stationary, found by Newton's
// method in the tangent plane. The ways' second derivatives are exact; how the surface bends is measured (surface_bend.glsl).
// Steps stay in a region that shrinks when one fails (over bands and concave places the curvature is measured once more); after two
// failures the paper's direction is followed instead. Along a thin rim the way is a narrow valley, in which every step climbs a
// little: there a step is right, too, if Newton's method, where it began, has less way to go afterwards (Deuflhard 1974).
// Hidden vertices need nothing of their own: a vertex and its mirror image have the same tangential part.
// From the host, beside surface_at:
//   MapWindow map_window()   what its centre sees of the reflector
// Needs reflection_point.glsl and map_window.glsl.
#include "reflections/reflection_search/surface_bend.glsl"

const float first_region = 0.25f;      // the longest first step: radians seen from the centre; on bands the normal turns by no more
const float min_curvature = 1e-3f;   // of a way over a convex reflector, relative to its greatest
const float near_error = 2e-7f;        // 0.05 degrees
const float near_step = 2e-3f;         // of the distance from the centre, for a body seen all around: about a texel
const float seen_error = 0.25f;        // beyond it, 60 degrees, the viewer may look at the surface's back

// What a step may make of the error. Its valleys bend: who may climb a little finds more points, but neighbouring vertices then
// end less often in the same.
const float free_growth = 1.1f;
const float steady_growth = 0.95f;

// A place where searches may begin.
struct SearchStart {
  TangentPlane plane;
  vec3 bend;  // of the surface, about as far as half the way to the next such place
};

// A place of the search: the surface there, its tangent plane, and the way over it.
struct Way {
  TangentPlane plane;
  vec2 slope;   // of the way's length
  vec3 bend;    // its second derivatives for a flat surface: uu, uv, vv
  float lift;   // what the surface's own bend counts for
  float length_m;
  float error;
};

// Equation 1 from the sum of the two directions: how far it leans in the tangent plane, and how high it stands on it.
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

// `u`: about where the tangent frame is to point.
GLSL_FUNCTION Way way_at(ReflectionTask task, vec3 direction, vec3 u) {
  return way_over(task, tangent_plane(surface_at(direction), window_frame(map_window(), direction, u)));
}

// To where the slope vanishes. Over a convex reflector the way is shortest there, so it must bend upward everywhere.
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

// What Newton's method has to go where its slope would be another.
GLSL_FUNCTION float way_to_go(Way way, vec2 slope, vec3 surface, bool is_convex) {
  way.slope = slope;
  return length(newton_step(way, surface, is_convex));
}

// When a search ends, and what its steps may do.
struct SearchBounds {
  bool is_convex;     // believe that the way is shortest at the point
  float max_growth;  // of the error, in a step
  int max_steps;
  int max_failures;  // steps that lead nowhere
  float min_error;
  bool stays_on_surface;  // not even for a while over what closes it
};

struct SearchEnd {
  PatchPoint found;
  SearchStart last;  // looked up: a search may go on from there
};

// Near the point the last step needs no look: where it leads is known from how
// the surface bends.
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

// Where a ray from the centre meets the surface.
GLSL_FUNCTION SearchStart start_along(ReflectionTask task, vec3 direction) {
  TangentPlane plane = tangent_plane(surface_at(direction), window_frame(map_window(), direction, vec3(0.0f)));
  return SearchStart(plane, surface_bend(plane, task.centre, window_breadth(map_window())));
}

GLSL_FUNCTION ReflectionPoint search_by_newton(ReflectionTask task, vec3 start, bool is_convex, float max_growth,
                                               int max_steps, float min_error) {
  SearchBounds bounds = SearchBounds(is_convex, max_growth, max_steps, max_steps, min_error, false);
  return search_from(task, start_along(task, start), bounds).found.point;
}
