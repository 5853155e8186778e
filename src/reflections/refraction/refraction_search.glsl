// Where does a body of solid glass show a vertex? Estalella and others 2005 leave it open (section 8): "the study of the analytic
// properties of the equivalent error functions". The way viewer - entry - exit - vertex obeys Snell's law at both points of the
// surface where its optical length |OP| + n |PQ| + |QV| is stationary (Fermat). The error is how far from that it is: at each point
// the difference of both sides of Snell's law, sines of angles times indices. Newton's method finds both points at once, in their
// tangent planes, in a region that shrinks when a step fails.
//
// The shortest way need not be it: a ball lens gathers rays in a focus, and behind it things stand upside down. The number of
// foci that a ray has passed before it meets the vertex (0, 1 or 2) is the number of directions in which its way is longest
// (Morse). A vertex near the focus is shown several times, as a rule once with each number: so each number has a layer.
//
// A search begins with the best of some rays that were traced through the body for the viewer. From the host:
//   mat4 refraction_start(int i)   such a ray: where it enters, where it leaves, its way from there; w: of the first two, how far
//                                  behind the exit its foci are
// Needs surface_point.glsl.
#include "reflections/reflection_search/surface_bend.glsl"

const int refraction_start_count = 37;
const int refraction_layers = 3;
const int refraction_attempts = 3;
const int refraction_steps = 14;
const float refraction_found = 2e-4f;  // difference of the sides of Snell's law, about radians: a search ends
const float refraction_lost = 2e-3f;   // beyond it there is no such point
const float longest_refraction_step = 0.3f;  // of the distance from the centre, first
const float wrong_side_weight = 4.0f;        // of a viewer or a vertex behind the surface, in the error

struct RefractionTask {
  vec3 viewer;
  vec3 vertex;
  vec3 centre;  // that directions start from
  float ior;
};

// A way through the body.
struct GlassWay {
  TangentPlane entry;
  TangentPlane exit;
  vec3 seen;    // unit vectors: to the entry, to the exit, to the vertex
  vec3 within;
  vec3 behind;
  vec3 lengths;
  vec4 slope;   // of the optical length, in both tangent planes
  float error;  // squared
};

GLSL_FUNCTION GlassWay glass_way(RefractionTask task, vec3 to_entry, vec3 to_exit, vec3 entry_u, vec3 exit_u) {
  GlassWay way;
  way.entry = tangent_plane(surface_at(to_entry), entry_u);
  way.exit = tangent_plane(surface_at(to_exit), exit_u);
  way.seen = way.entry.at.position - task.viewer;
  way.within = way.exit.at.position - way.entry.at.position;
  way.behind = task.vertex - way.exit.at.position;
  way.lengths = max(vec3(length(way.seen), length(way.within), length(way.behind)), vec3(1e-12f));
  way.seen /= way.lengths.x;
  way.within /= way.lengths.y;
  way.behind /= way.lengths.z;
  vec2 at_entry = in_tangent_plane(way.entry, way.seen - task.ior * way.within);
  vec2 at_exit = in_tangent_plane(way.exit, task.ior * way.within - way.behind);
  way.slope = vec4(at_entry.x, at_entry.y, at_exit.x, at_exit.y);
  float back = max(dot(way.seen, way.entry.at.normal), 0.0f), below = max(-dot(way.behind, way.exit.at.normal), 0.0f);
  way.error = dot(way.slope, way.slope) + wrong_side_weight * (back * back + below * below);
  return way;
}

// The second derivatives of the optical length; the bends are the surface's at both points.
GLSL_FUNCTION mat4 bends_of_way(RefractionTask task, GlassWay way, vec3 entry_bend, vec3 exit_bend) {
  vec2 a = in_tangent_plane(way.entry, way.seen), b = in_tangent_plane(way.entry, way.within);
  vec2 c = in_tangent_plane(way.exit, way.within), d = in_tangent_plane(way.exit, way.behind);
  float k = 1.0f / way.lengths.x, m = task.ior / way.lengths.y, n = 1.0f / way.lengths.z;
  vec3 e = dot(task.ior * way.within - way.seen, way.entry.at.normal) * entry_bend +
           vec3(k * (1.0f - a.x * a.x) + m * (1.0f - b.x * b.x), -k * a.x * a.y - m * b.x * b.y,
                k * (1.0f - a.y * a.y) + m * (1.0f - b.y * b.y));
  vec3 x = dot(way.behind - task.ior * way.within, way.exit.at.normal) * exit_bend +
           vec3(m * (1.0f - c.x * c.x) + n * (1.0f - d.x * d.x), -m * c.x * c.y - n * d.x * d.y,
                m * (1.0f - c.y * c.y) + n * (1.0f - d.y * d.y));
  float uu = m * (b.x * c.x - dot(way.entry.u, way.exit.u)), uv = m * (b.x * c.y - dot(way.entry.u, way.exit.v));
  float vu = m * (b.y * c.x - dot(way.entry.v, way.exit.u)), vv = m * (b.y * c.y - dot(way.entry.v, way.exit.v));
  return mat4(vec4(e.x, e.y, uu, uv), vec4(e.y, e.z, vu, vv), vec4(uu, vu, x.x, x.y), vec4(uv, vv, x.y, x.z));
}

// Equations with a symmetric matrix, by elimination: their solution, and the number of negative pivots. That is the number of
// directions in which the way is longest (Sylvester's law of inertia). Written out: not all compilers of shaders index a matrix by
// a variable as they should.
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

// Where the slope vanishes, if the way bends as it does here; else downhill for the error.
GLSL_FUNCTION vec4 refraction_step(vec4 slope, mat4 bends, bool goes_downhill) {
  vec4 uphill = bends * slope, change = bends * uphill;
  vec4 downhill = -uphill * (dot(uphill, uphill) / max(dot(change, change), 1e-20f));
  vec4 newton = -solution(bends, slope).x;
  bool is_usable = dot(newton, newton) < 1e12f;
  return goes_downhill || !is_usable ? downhill : newton;
}

// The last way of a search.
struct RefractedPoint {
  SurfacePoint entry;
  SurfacePoint exit;
  float length;  // from the viewer to the vertex
  float error;   // of Snell's law
  int foci;
};

GLSL_FUNCTION RefractedPoint search_refraction(RefractionTask task, vec3 to_entry, vec3 to_exit) {
  GlassWay way = glass_way(task, to_entry, to_exit, vec3(0.0f), vec3(0.0f));
  vec3 entry_bend = surface_bend(way.entry, task.centre, 1.0f), exit_bend = surface_bend(way.exit, task.centre, 1.0f);
  float region = longest_refraction_step * length(to_entry);
  int failures = 0;
  for (int i = 0; i < refraction_steps && way.error >= refraction_found * refraction_found; ++i) {
    vec4 d = refraction_step(way.slope, bends_of_way(task, way, entry_bend, exit_bend), failures >= 2);
    float size = length(d);
    if (size > region) d *= region / size;
    GlassWay next = glass_way(task, on_tangent_plane(way.entry, vec2(d.x, d.y)) - task.centre,
                              on_tangent_plane(way.exit, vec2(d.z, d.w)) - task.centre, way.entry.u, way.exit.u);
    entry_bend = bend_after_step(entry_bend, in_tangent_plane(way.entry, next.entry.at.position - way.entry.at.position),
                                 in_tangent_plane(way.entry, next.entry.at.normal));
    exit_bend = bend_after_step(exit_bend, in_tangent_plane(way.exit, next.exit.at.position - way.exit.at.position),
                                in_tangent_plane(way.exit, next.exit.at.normal));
    if (next.error < way.error) {
      region = max(region, 2.0f * min(size, region));
      failures = 0;
      way = next;
    } else {
      region = 0.3f * min(size, region);
      failures += 1;
    }
  }
  return RefractedPoint(way.entry.at, way.exit.at, way.lengths.x + way.lengths.y + way.lengths.z, sqrt(way.error),
                        solution(bends_of_way(task, way, entry_bend, exit_bend), way.slope).negative_pivots);
}

// How far a ray that was traced misses the vertex, squared: about an angle, and for what is near a share of the body. No more than
// max_miss lies between two rays, so what all of them miss by more is not shown: that is most of a scene.
const float max_miss = 0.36f;

GLSL_FUNCTION float miss_of_start(RefractionTask task, mat4 start, int foci) {
  vec3 exit = vec3(start[1].x, start[1].y, start[1].z);
  vec3 to_vertex = task.vertex - exit;
  float far = length(to_vertex);
  vec3 off = (to_vertex - far * vec3(start[2].x, start[2].y, start[2].z)) / (far + 0.5f * length(exit - task.centre));
  int passed = (far > start[0].w ? 1 : 0) + (far > start[1].w ? 1 : 0);
  return passed == foci ? dot(off, off) : 2.0f * max_miss;
}

GLSL_FUNCTION bool is_refracted(RefractedPoint p, int foci) { return p.error < refraction_lost && p.foci == foci; }

// The image of the vertex that has passed so many foci; told by is_refracted.
GLSL_FUNCTION RefractedPoint refracted_vertex(RefractionTask task, int foci) {
  SurfacePoint nowhere = SurfacePoint(task.centre, vec3(0.0f), 0.0f);
  RefractedPoint best = RefractedPoint(nowhere, nowhere, 0.0f, 4.0f, -1);
  float tried = -1.0f;  // the misses of starts that were: those that are left miss by more
  for (int k = 0; k < refraction_attempts; ++k) {
    int next = -1;
    float least = max_miss;
    for (int i = 0; i < refraction_start_count; ++i) {
      float miss = miss_of_start(task, refraction_start(i), foci);
      if (miss > tried && miss < least) {
        least = miss;
        next = i;
      }
    }
    if (next < 0) return best;
    tried = least;
    mat4 start = refraction_start(next);
    RefractedPoint found = search_refraction(task, vec3(start[0].x, start[0].y, start[0].z) - task.centre,
                                             vec3(start[1].x, start[1].y, start[1].z) - task.centre);
    if (is_refracted(found, foci)) return found;
    if (found.error < best.error) best = found;
  }
  return best;
}
