// Which part of all directions a reflector map holds: a square window of an octahedral layer about the patch's middle, so that
// a patch that its centre sees in a narrow cone has all the texels. Needs octahedral.glsl.

struct MapWindow {
  vec3 centre;
  mat3 axes;     // columns; the third points to the middle
  float extent;  // of the layer; 1: all directions
  float side;    // texels
  float reach;   // greatest distance from the centre
};

// What the square between four texels holds.
const float kind_surface = 0.0f;
const float kind_crease = 1.0f;  // the surface turns within it by more than can be interpolated
const float kind_closed = 2.0f;  // none: what closes an open surface, so that searches find their way over it

const float map_border = 1.0f;  // texels that repeat what lies across the sides

GLSL_FUNCTION vec2 window_uv(MapWindow window, vec3 direction) {
  vec3 d = vec3(dot(window.axes[0], direction), dot(window.axes[1], direction), dot(window.axes[2], direction));
  vec2 uv = (octahedral_uv(d) - vec2(0.5f)) / window.extent + vec2(0.5f);
  return uv_in_layer(clamp(uv, vec2(0.0f), vec2(1.0f)), window.side, map_border);
}

GLSL_FUNCTION vec3 window_direction(MapWindow window, vec2 uv) {
  vec2 within = (uv * window.side - vec2(map_border)) / (window.side - 2.0f * map_border);
  return window.axes * octahedral_direction((within - vec2(0.5f)) * window.extent + vec2(0.5f));
}
