// Image of a vertex in a body of solid glass. Estalella and others 2005 leave it open (section 8): "the study
// of the analytic properties of the equivalent error functions". The path viewer - entry - exit - vertex
// obeys Snell's law at both points of the surface where its optical length |OP| + n |PQ| + |QV| is stationary
// (Fermat). Error: at each point the difference of both sides of Snell's law, sines of angles times indices.
// Newton's method finds both points together, in their tangent planes, within a trust region that shrinks
// when a step fails.
//
// The path need not be the shortest: a ball lens focuses rays, and objects behind the focus appear upside
// down. The number of foci that a ray has passed before it reaches the vertex (0, 1 or 2) is the number of
// directions in which its length has a maximum (Morse index). A vertex near the focus has several images, as
// a rule one for each number: each number has a layer.
//
// A search starts from the best of some rays that were traced through the body for the viewer. Required from
// the host:
//   mat4 refraction_start(int i)   columns: entry, exit, direction of the ray behind the exit;
//                                  w of the first two: distances of its foci behind the exit
// Needs surface_point.glsl.
#include "reflections/reflection_search/surface_curvature.glsl"

const int refraction_attempts = 3;
const int refraction_steps = 14;
const float refraction_found = 2e-4f;  // difference of the sides of Snell's law, about radians: termination
const float refraction_lost = 2e-3f;   // points with a larger error are rejected
const float first_refraction_region = 0.3f;  // maximum first step, relative to the distance from the centre
const float wrong_side_weight = 4.0f;        // weight in the error of a viewer or a vertex behind the surface

struct RefractionTask {
  vec3 viewer;
  vec3 vertex;
  vec3 centre;  // origin of directions
  float ior;
};

// State of the search: the path through the body.
struct GlassPath {
  TangentPlane entry;
  TangentPlane exit;
  vec3 before;  // unit directions: viewer to entry, entry to exit, exit to vertex
  vec3 within;
  vec3 behind;
  vec3 lengths;
  vec4 gradient;  // of the optical length, in both tangent planes
  float error;    // squared
};

GLSL_FUNCTION GlassPath glass_path(RefractionTask task, vec3 to_entry, vec3 to_exit, vec3 entry_u,
                                   vec3 exit_u) {
  GlassPath path;
  path.entry = tangent_plane(surface_at(to_entry), entry_u);
  path.exit = tangent_plane(surface_at(to_exit), exit_u);
  path.before = path.entry.at.position - task.viewer;
  path.within = path.exit.at.position - path.entry.at.position;
  path.behind = task.vertex - path.exit.at.position;
  path.lengths = max(vec3(length(path.before), length(path.within), length(path.behind)), vec3(1e-12f));
  path.before /= path.lengths.x;
  path.within /= path.lengths.y;
  path.behind /= path.lengths.z;
  vec2 at_entry = in_tangent_plane(path.entry, path.before - task.ior * path.within);
  vec2 at_exit = in_tangent_plane(path.exit, task.ior * path.within - path.behind);
  path.gradient = vec4(at_entry.x, at_entry.y, at_exit.x, at_exit.y);
  float back = max(dot(path.before, path.entry.at.normal), 0.0f),
        below = max(-dot(path.behind, path.exit.at.normal), 0.0f);
  path.error = dot(path.gradient, path.gradient) + wrong_side_weight * (back * back + below * below);
  return path;
}

// Second derivatives of the optical length, from the curvatures of the surface at both points.
GLSL_FUNCTION mat4 hessian_of_path(RefractionTask task, GlassPath path, vec3 entry_curvature,
                                   vec3 exit_curvature) {
  vec2 a = in_tangent_plane(path.entry, path.before), b = in_tangent_plane(path.entry, path.within);
  vec2 c = in_tangent_plane(path.exit, path.within), d = in_tangent_plane(path.exit, path.behind);
  float k = 1.0f / path.lengths.x, m = task.ior / path.lengths.y, n = 1.0f / path.lengths.z;
  vec3 e = dot(task.ior * path.within - path.before, path.entry.at.normal) * entry_curvature +
           vec3(k * (1.0f - a.x * a.x) + m * (1.0f - b.x * b.x), -k * a.x * a.y - m * b.x * b.y,
                k * (1.0f - a.y * a.y) + m * (1.0f - b.y * b.y));
  vec3 x = dot(path.behind - task.ior * path.within, path.exit.at.normal) * exit_curvature +
           vec3(m * (1.0f - c.x * c.x) + n * (1.0f - d.x * d.x), -m * c.x * c.y - n * d.x * d.y,
                m * (1.0f - c.y * c.y) + n * (1.0f - d.y * d.y));
  float uu = m * (b.x * c.x - dot(path.entry.u, path.exit.u)),
        uv = m * (b.x * c.y - dot(path.entry.u, path.exit.v));
  float vu = m * (b.y * c.x - dot(path.entry.v, path.exit.u)),
        vv = m * (b.y * c.y - dot(path.entry.v, path.exit.v));
  return mat4(vec4(e.x, e.y, uu, uv), vec4(e.y, e.z, vu, vv), vec4(uu, vu, x.x, x.y), vec4(uv, vv, x.y, x.z));
}

// Solution of a symmetric linear system by elimination, and its number of negative pivots, which is the
// number of directions in which the length has a maximum (Sylvester's law of inertia). Unrolled, because some
// shader compilers fail to index a matrix by a variable.
struct Solution {
  vec4 x;
  int negative_pivots;
};

GLSL_FUNCTION float pivot_of(float x) { return abs(x) < 1e-9f ? 1e-9f : x; }

GLSL_FUNCTION Solution solution(mat4 symmetric, vec4 r) {
  vec4 a = symmetric[0], b = symmetric[1], c = symmetric[2], d = symmetric[3];
  float pa = pivot_of(a.x);
  float fb = b.x / pa, fc = c.x / pa, fd = d.x / pa;
  b -= a * fb;
  c -= a * fc;
  d -= a * fd;
  r -= vec4(0.0f, fb, fc, fd) * r.x;
  float pb = pivot_of(b.y);
  fc = c.y / pb;
  fd = d.y / pb;
  c -= b * fc;
  d -= b * fd;
  r -= vec4(0.0f, 0.0f, fc, fd) * r.y;
  float pc = pivot_of(c.z);
  fd = d.z / pc;
  d -= c * fd;
  r -= vec4(0.0f, 0.0f, 0.0f, fd) * r.z;
  float pd = pivot_of(d.w);
  vec4 x;
  x.w = r.w / pd;
  x.z = (r.z - c.w * x.w) / pc;
  x.y = (r.y - b.z * x.z - b.w * x.w) / pb;
  x.x = (r.x - a.y * x.y - a.z * x.z - a.w * x.w) / pa;
  return Solution(x, (pa < 0.0f ? 1 : 0) + (pb < 0.0f ? 1 : 0) + (pc < 0.0f ? 1 : 0) + (pd < 0.0f ? 1 : 0));
}

// Newton's step, to where the gradient vanishes; after failures, steepest descent of the error.
GLSL_FUNCTION vec4 refraction_step(vec4 gradient, mat4 hessian, bool descends) {
  vec4 uphill = hessian * gradient, change = hessian * uphill;
  vec4 downhill = -uphill * (dot(uphill, uphill) / max(dot(change, change), 1e-20f));
  vec4 newton = -solution(hessian, gradient).x;
  bool is_usable = dot(newton, newton) < 1e12f;
  return descends || !is_usable ? downhill : newton;
}

// Result of a search.
struct RefractedPoint {
  SurfacePoint entry;
  SurfacePoint exit;
  float length;  // from the viewer to the vertex
  float error;   // of Snell's law
  int foci;
};

GLSL_FUNCTION RefractedPoint search_refraction(RefractionTask task, vec3 to_entry, vec3 to_exit) {
  GlassPath path = glass_path(task, to_entry, to_exit, vec3(0.0f), vec3(0.0f));
  vec3 entry_curvature = surface_curvature(path.entry, task.centre, 1.0f),
       exit_curvature = surface_curvature(path.exit, task.centre, 1.0f);
  float region = first_refraction_region * length(to_entry);
  int failures = 0;
  for (int i = 0; i < refraction_steps && path.error >= refraction_found * refraction_found; ++i) {
    vec4 d = refraction_step(path.gradient, hessian_of_path(task, path, entry_curvature, exit_curvature),
                             failures >= 2);
    float size = length(d);
    if (size > region) d *= region / size;
    GlassPath next =
        glass_path(task, on_tangent_plane(path.entry, vec2(d.x, d.y)) - task.centre,
                   on_tangent_plane(path.exit, vec2(d.z, d.w)) - task.centre, path.entry.u, path.exit.u);
    entry_curvature = curvature_after_step(
        entry_curvature, in_tangent_plane(path.entry, next.entry.at.position - path.entry.at.position),
        in_tangent_plane(path.entry, next.entry.at.normal));
    exit_curvature = curvature_after_step(
        exit_curvature, in_tangent_plane(path.exit, next.exit.at.position - path.exit.at.position),
        in_tangent_plane(path.exit, next.exit.at.normal));
    if (next.error < path.error) {
      region = max(region, 2.0f * min(size, region));
      failures = 0;
      path = next;
    } else {
      region = 0.3f * min(size, region);
      failures += 1;
    }
  }
  return RefractedPoint(
      path.entry.at, path.exit.at, path.lengths.x + path.lengths.y + path.lengths.z, sqrt(path.error),
      solution(hessian_of_path(task, path, entry_curvature, exit_curvature), path.gradient).negative_pivots);
}

// Squared distance by which a traced ray misses the vertex: about an angle; for near vertices relative to the
// size of the body. Neighbouring rays are at most max_miss apart, so a vertex that all of them miss by more
// is not visible: that is most of a scene.
const float max_miss = 0.36f;

GLSL_FUNCTION float miss_of_start(RefractionTask task, mat4 start, int foci) {
  vec3 exit = vec3(start[1].x, start[1].y, start[1].z);
  vec3 to_vertex = task.vertex - exit;
  float far = length(to_vertex);
  vec3 off = (to_vertex - far * vec3(start[2].x, start[2].y, start[2].z)) /
             (far + 0.5f * length(exit - task.centre));
  int passed = (far > start[0].w ? 1 : 0) + (far > start[1].w ? 1 : 0);
  return passed == foci ? dot(off, off) : 2.0f * max_miss;
}

GLSL_FUNCTION bool is_refracted(RefractedPoint p, int foci) {
  return p.error < refraction_lost && p.foci == foci;
}

// Image of the vertex over `foci` foci; is_refracted says whether there is one.
GLSL_FUNCTION RefractedPoint refracted_vertex(RefractionTask task, int foci) {
  SurfacePoint nowhere = SurfacePoint(task.centre, vec3(0.0f), 0.0f);
  RefractedPoint best = RefractedPoint(nowhere, nowhere, 0.0f, 4.0f, -1);
  float tried = -1.0f;  // largest miss of the starts tried so far
  for (int k = 0; k < refraction_attempts; ++k) {
    int next = -1;
    float min_miss = max_miss;
    for (int i = 0; i < refraction_start_count; ++i) {
      float miss = miss_of_start(task, refraction_start(i), foci);
      if (miss > tried && miss < min_miss) {
        min_miss = miss;
        next = i;
      }
    }
    if (next < 0) return best;
    tried = min_miss;
    mat4 start = refraction_start(next);
    RefractedPoint found = search_refraction(task, vec3(start[0].x, start[0].y, start[0].z) - task.centre,
                                             vec3(start[1].x, start[1].y, start[1].z) - task.centre);
    if (is_refracted(found, foci)) return found;
    if (found.error < best.error) best = found;
  }
  return best;
}
