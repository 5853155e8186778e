// The reflection point as the shortest way over the reflector (Fermat): where |OP| + |PV| is stationary, found by Newton's
// method in the tangent plane. The ways' second derivatives are exact; how the surface bends is measured once, by two more
// points, and kept up to date by what each step meets (Powell's symmetric update of a secant). Steps stay in a region that
// shrinks when one fails; after two failures the paper's direction is followed instead.
// Hidden vertices need nothing of their own: a vertex and its mirror image have the same tangential part.
// Needs reflection_point.glsl.

const float probe_size = 0.02f;        // of the distance from the centre: how far off the surface's bend is measured
const float first_region = 0.25f;      // of the distance from the centre: the longest first step
const float least_curvature = 1e-3f;   // of a way over a convex reflector, relative to its greatest
const float seen_error = 0.25f;        // beyond it, 60 degrees, the viewer may look at the surface's back

// What a step may make of the error. Its valleys bend: who may climb a little finds more points, but neighbouring vertices then
// end less often in the same.
const float free_growth = 1.1f;
const float steady_growth = 0.95f;

// A place of the search: the surface there, its tangent plane, and the way over it.
struct Way {
  SurfacePoint at;
  vec3 direction;
  vec3 u;  // unit vectors of the tangent plane
  vec3 v;
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
  way.at = surface_at(direction);
  vec3 normal = way.at.normal;
  vec3 across = abs(normal.x) < 0.8f ? vec3(1.0f, 0.0f, 0.0f) : vec3(0.0f, 1.0f, 0.0f);
  way.u = u - dot(u, normal) * normal;
  if (dot(way.u, way.u) < 1e-4f) way.u = across - dot(across, normal) * normal;
  way.u = normalize(way.u);
  way.v = cross(normal, way.u);
  vec3 to_viewer = task.viewer - way.at.position, to_vertex = task.vertex - way.at.position;
  float viewer_m = max(length(to_viewer), 1e-12f), vertex_m = max(length(to_vertex), 1e-12f);
  to_viewer /= viewer_m;
  to_vertex /= vertex_m;
  vec2 a = vec2(dot(to_viewer, way.u), dot(to_viewer, way.v)), b = vec2(dot(to_vertex, way.u), dot(to_vertex, way.v));
  way.slope = -(a + b);
  way.bend = vec3((1.0f - a.x * a.x) / viewer_m + (1.0f - b.x * b.x) / vertex_m,
                  -a.x * a.y / viewer_m - b.x * b.y / vertex_m,
                  (1.0f - a.y * a.y) / viewer_m + (1.0f - b.y * b.y) / vertex_m);
  way.lift = dot(to_viewer + to_vertex, normal);
  way.length_m = viewer_m + vertex_m;
  way.error = bisector_error(bisector(task.viewer, task.vertex, way.at), normal);
  return way;
}

GLSL_FUNCTION vec2 in_tangent_plane(Way way, vec3 d) { return vec2(dot(d, way.u), dot(d, way.v)); }

GLSL_FUNCTION vec2 times(vec3 symmetric, vec2 d) {
  return vec2(symmetric.x * d.x + symmetric.y * d.y, symmetric.y * d.x + symmetric.z * d.y);
}

// How the normal turns along u and v, as a symmetric matrix: by two points nearby.
GLSL_FUNCTION vec3 surface_bend(ReflectionTask task, Way way) {
  vec3 from_centre = way.at.position - task.centre;
  float probe = probe_size * length(from_centre);
  SurfacePoint along_u = surface_at(from_centre + probe * way.u), along_v = surface_at(from_centre + probe * way.v);
  vec2 su = in_tangent_plane(way, along_u.position - way.at.position), nu = in_tangent_plane(way, along_u.normal);
  vec2 sv = in_tangent_plane(way, along_v.position - way.at.position), nv = in_tangent_plane(way, along_v.normal);
  float area = su.x * sv.y - su.y * sv.x;
  if (abs(area) < 0.1f * probe * probe) return vec3(nu.x / probe, 0.5f * (nu.y + nv.x) / probe, nv.y / probe);
  return vec3(nu.x * sv.y - nv.x * su.y, 0.5f * (nv.x * su.x - nu.x * sv.x + nu.y * sv.y - nv.y * su.y),
              nv.y * su.x - nu.y * sv.x) / area;
}

// The least change of the bend that agrees with a step s along which the normal turned by n.
GLSL_FUNCTION vec3 bend_after_step(vec3 bend, vec2 s, vec2 n) {
  float size = dot(s, s);
  if (size < 1e-20f) return bend;
  vec2 off = n - times(bend, s);
  float part = dot(off, s) / (size * size);
  return bend + vec3(2.0f * off.x * s.x / size - part * s.x * s.x, (off.x * s.y + off.y * s.x) / size - part * s.x * s.y,
                     2.0f * off.y * s.y / size - part * s.y * s.y);
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

GLSL_FUNCTION vec2 shortened(vec2 d, float longest) {
  float size = length(d);
  return size > longest ? d * (longest / size) : d;
}

GLSL_FUNCTION ReflectionPoint search_by_newton(ReflectionTask task, vec3 start, bool is_convex, float most_growth,
                                               int most_steps, float least_error) {
  Way way = way_over(task, start, vec3(0.0f));
  vec3 surface = surface_bend(task, way);  // before the loop: software renderers run both sides of a branch
  float region = first_region * length(way.at.position - task.centre);
  int failures = 0;
  for (int i = 0; i < most_steps && way.error >= least_error; ++i) {
    vec2 d = newton_step(way, surface, is_convex);
    if (failures >= 2) d = -way.slope / max(way.bend.x + way.bend.z + abs(way.lift) * length(surface), 1e-12f);
    d = shortened(d, region);
    Way next = way_over(task, way.at.position + d.x * way.u + d.y * way.v - task.centre, way.u);
    vec3 moved = next.at.position - way.at.position;
    surface = bend_after_step(surface, in_tangent_plane(way, moved), in_tangent_plane(way, next.at.normal));
    bool is_shorter = is_convex && way.length_m - next.length_m > -0.1f * dot(way.slope, d);
    if (next.error < most_growth * way.error || (is_shorter && next.error < seen_error)) {
      region = max(region, 2.0f * length(d));
      failures = 0;
      way = next;
    } else {
      region = 0.3f * length(d);
      failures += 1;
    }
  }
  return reflection_point(way.at, normalize(way.direction), way.error);
}
