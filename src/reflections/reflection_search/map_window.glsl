// Which part of all directions a reflector map holds: a square window of an octahedral layer about the
// patch's middle, so that a patch that its centre sees in a narrow cone has all the texels; or a band about
// an axis, so that a rim or a bar has. Needs octahedral.glsl.

struct MapWindow {
  vec3 centre;
  mat3 axes;  // columns; the third points to the middle, or along a band's axis, the first then to the band's
              // middle
  float extent;  // of the layer; 1: all directions; 0: a band
  float side;    // texels
  float reach;   // greatest distance from the centre
  vec3 band;     // angles: half its turn about the axis, where it begins off the axis, its breadth
};

// What the square between four texels holds.
const float kind_surface = 0.0f;
const float kind_crease = 1.0f;  // the surface turns within it by more than can be interpolated
const float kind_closed = 2.0f;  // none: what closes an open surface, so that searches find their way over it

const float map_border = 1.0f;  // texels that repeat what lies across the sides

// 1 or 0, for loops in place of branches: software renderers run both sides of those. ALL_PLAIN: every patch
// is convex, shows a vertex once, and is no band: what others cost falls away.
#ifdef ALL_PLAIN
#define band_count(window) 0
#else
GLSL_FUNCTION int band_count(MapWindow window) { return window.extent > 0.0f ? 0 : 1; }
#endif

GLSL_FUNCTION vec2 window_uv(MapWindow window, vec3 direction) {
  vec3 d =
      vec3(dot(window.axes[0], direction), dot(window.axes[1], direction), dot(window.axes[2], direction));
  vec2 uv = (octahedral_uv(d) - vec2(0.5f)) / max(window.extent, 1e-12f) + vec2(0.5f);
  for (int bands = band_count(window); bands > 0; --bands)
    uv = vec2(0.5f * atan(d.y, d.x) / window.band.x + 0.5f,
              (atan(length(vec2(d.x, d.y)), d.z) - window.band.y) / window.band.z);
  return uv_in_layer(clamp(uv, vec2(0.0f), vec2(1.0f)), window.side, map_border);
}

GLSL_FUNCTION vec3 window_direction(MapWindow window, vec2 uv) {
  vec2 within = (uv * window.side - vec2(map_border)) / (window.side - 2.0f * map_border);
  if (band_count(window) == 0)
    return window.axes * octahedral_direction((within - vec2(0.5f)) * window.extent + vec2(0.5f));
  float turn = (2.0f * within.x - 1.0f) * window.band.x, off_axis = window.band.y + within.y * window.band.z;
  return window.axes * vec3(sin(off_axis) * cos(turn), sin(off_axis) * sin(turn), cos(off_axis));
}

// Of the patch as its centre sees it, 1: all around.
GLSL_FUNCTION float window_breadth(MapWindow window) {
  return band_count(window) == 0 ? window.extent : window.band.z;
}

// A step from a place of the patch, both from the centre; over a band it turns about the axis, as rims do.
GLSL_FUNCTION vec3 window_step(MapWindow window, vec3 from_centre, vec3 step) {
  vec3 to = from_centre + step;
  for (int bands = band_count(window); bands > 0; --bands) {
    vec3 axis = window.axes[2];
    vec3 off_axis = from_centre - dot(from_centre, axis) * axis;
    float radius = max(length(off_axis), 1e-12f);
    vec3 outward = off_axis / radius, around = cross(axis, outward);
    float turn = dot(step, around) / radius;
    to = from_centre - off_axis + dot(step, axis) * axis +
         (radius + dot(step, outward)) * (cos(turn) * outward + sin(turn) * around);
  }
  return to;
}

// About where a tangent plane's first axis is to point at a place, `u`: where it pointed at the place before.
GLSL_FUNCTION vec3 window_frame(MapWindow window, vec3 from_centre, vec3 u) {
  return band_count(window) == 0 ? u : cross(window.axes[2], from_centre);
}
