// The reflection point as the shortest way over the reflector (Fermat): where |OP| + |PV| is stationary, found by Newton's
// method in the tangent plane. The ways' second derivatives are exact; how the surface bends is measured (surface_bend.glsl).
// Steps stay in a region that shrinks when one fails (over bands and hollows how the surface bends is measured again); after two
// failures the paper's direction is followed instead. Along a thin rim the way is a narrow valley, in which every step climbs a
// little: there a step is right, too, if Newton's method, where it began, has less way to go afterwards (Deuflhard 1974).
// Hidden vertices need nothing of their own: a vertex and its mirror image have the same tangential part.
// From the host, beside surface_at:
//   MapWindow map_window()   what its centre sees of the reflector
// Needs reflection_point.glsl and map_window.glsl.
#include "curved_reflectors/surface_bend.glsl"

const float first_region = 0.25f;      // the longest first step: radians seen from the centre; on bands the normal turns by no more
const float least_curvature = 1e-3f;   // of a way over a convex reflector, relative to its greatest
const float seen_error = 0.25f;        // beyond it, 60 degrees, the viewer may look at the surface's back

// What a step may make of the error. Its valleys bend: who may climb a little finds more points, but neighbouring vertices then
// end less often in the same.
const float free_growth = 1.1f;
const float steady_growth = 0.95f;

// A place of the search: the surface there, its tangent plane, and the way over it.
struct Way {
  TangentPlane plane;
  vec3 direction;
  vec2 slope;     // of the way's length
  vec3 bend;      // its second derivatives for a flat surface: uu, uv, vv
  float lift;     // what the surface's own bend counts for
  float length_m;
  float error;
};

// `u`: about where the tangent frame is to point.
GLSL_FUNCTION Way way_over(ReflectionTask task, vec3 direction, vec3 u) {
  Way way;
  way.direction = direction;
  way.plane = tangent_plane(surface_at(direction), window_frame(map_window(), direction, u));
  vec3 normal = way.plane.at.normal;
  vec3 to_viewer = task.viewer - way.plane.at.position, to_vertex = task.vertex - way.plane.at.position;
  float viewer_m = max(length(to_viewer), 1e-12f), vertex_m = max(length(to_vertex), 1e-12f);
  to_viewer /= viewer_m;
  to_vertex /= vertex_m;
  vec2 a = in_tangent_plane(way.plane, to_viewer), b = in_tangent_plane(way.plane, to_vertex);
  way.slope = -(a + b);
  way.bend = vec3((1.0f - a.x * a.x) / viewer_m + (1.0f - b.x * b.x) / vertex_m,
                  -a.x * a.y / viewer_m - b.x * b.y / vertex_m,
                  (1.0f - a.y * a.y) / viewer_m + (1.0f - b.y * b.y) / vertex_m);
  way.lift = dot(to_viewer + to_vertex, normal);
  way.length_m = viewer_m + vertex_m;
  way.error = bisector_error(bisector(task.viewer, task.vertex, way.plane.at), normal);
  return way;
}

// To where the slope vanishes. Over a convex reflector the way is shortest there, so it must bend upward everywhere.
GLSL_FUNCTION vec2 newton_step(Way way, vec3 surface, bool is_convex) {
  vec3 bend = way.bend + way.lift * surface;
  float middle = 0.5f * (bend.x + bend.z);
  float spread = sqrt(0.25f * (bend.x - bend.z) * (bend.x - bend.z) + bend.y * bend.y);
  if (is_convex) {
    float least = least_curvature * (abs(middle) + spread);
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

GLSL_FUNCTION ReflectionPoint search_by_newton(ReflectionTask task, vec3 start, bool is_convex, float most_growth,
                                               int most_steps, float least_error) {
  float breadth = window_breadth(map_window());
#ifdef ALL_PLAIN
  const int hard = 0;
#else
  int hard = is_convex ? band_count(map_window()) : 1;
#endif
  Way way = way_over(task, start, vec3(0.0f));
  vec3 surface = surface_bend(way.plane, task.centre, breadth);  // before the loop: software renderers run both sides of a branch
  float region = first_region;
  int failures = 0;
  for (int i = 0; i < most_steps && way.error >= least_error; ++i) {
    vec2 whole = newton_step(way, surface, is_convex);
    float to_go = length(whole);
    if (failures >= 2) whole = -way.slope / max(way.bend.x + way.bend.z + abs(way.lift) * length(surface), 1e-12f);
    vec3 from_centre = way.plane.at.position - task.centre;
    float size = length(whole) / length(from_centre);
    for (int bands = band_count(map_window()); bands > 0; --bands) size = max(size, length(times(surface, whole)));
    float part = min(1.0f, region / max(size, 1e-12f));
    vec2 d = part * whole;
    Way next = way_over(task, window_step(map_window(), from_centre, d.x * way.plane.u + d.y * way.plane.v), way.plane.u);
    bool is_shorter = is_convex && way.length_m - next.length_m > -0.1f * dot(way.slope, d);
    float growth = most_growth;
    bool is_nearer = false;
    for (int bands = band_count(map_window()); bands > 0; --bands) {
      growth = mix(1.0f, most_growth, part);
      is_nearer = way_to_go(way, next.slope, surface, is_convex) < (1.0f - 0.25f * part) * to_go;
    }
    bool is_better = next.error < growth * way.error ||
                     ((is_shorter || is_nearer) && next.error < seen_error);
    vec3 moved = next.plane.at.position - way.plane.at.position;
    surface = bend_after_step(surface, in_tangent_plane(way.plane, moved), in_tangent_plane(way.plane, next.plane.at.normal));
    if (is_better) {
      region = max(region, 2.0f * part * size);
      failures = 0;
      way = next;
    } else {
      region = 0.3f * part * size;
      failures += 1;
    }
    for (int probes = is_better ? 0 : hard; probes > 0; --probes) surface = surface_bend(way.plane, task.centre, breadth);
  }
  return reflection_point(way.plane.at, normalize(way.direction), way.error);
}
