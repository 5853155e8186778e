// Directions on a square, equal areas for equal solid angles (Clarberg 2008): the upper hemisphere is the inner diamond, the
// lower one folded out into the corners. One map of a layer then holds what a cube map holds in six faces, as sharp one
// way as another.

// Of a quarter turn, the share whose tangent is 0..1 (Abramowitz and Stegun 4.4.49, to 1e-5).
GLSL_FUNCTION float turn_of_tangent(float t) {
  float t2 = t * t;
  return 0.63661977f * t *
         (0.9998660f + t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + 0.0208351f * t2))));
}

GLSL_FUNCTION vec2 octahedral_uv(vec3 direction) {
  vec2 across = vec2(abs(direction.x), abs(direction.y));
  float r = sqrt(max(1.0f - abs(direction.z), 0.0f));
  float turn = turn_of_tangent(min(across.x, across.y) / max(max(across.x, across.y), 1e-20f));
  if (across.x < across.y) turn = 1.0f - turn;
  vec2 p = vec2(r - turn * r, turn * r);
  if (direction.z < 0.0f) p = vec2(1.0f - p.y, 1.0f - p.x);
  if (direction.x < 0.0f) p.x = -p.x;
  if (direction.y < 0.0f) p.y = -p.y;
  return 0.5f * p + vec2(0.5f);
}

// A unit vector. Beyond the square's sides the map goes on as it does across them: turned round by half about their
// middles.
GLSL_FUNCTION vec3 octahedral_direction(vec2 uv) {
  vec2 p = 2.0f * uv - vec2(1.0f);
  if (abs(p.x) > 1.0f) p = vec2(2.0f * sign(p.x) - p.x, -p.y);
  if (abs(p.y) > 1.0f) p = vec2(-p.x, 2.0f * sign(p.y) - p.y);
  float below = 1.0f - abs(p.x) - abs(p.y);  // 0: on the horizon
  float r = 1.0f - abs(below);
  float turn = r > 0.0f ? 0.78539816f * ((abs(p.y) - abs(p.x)) / r + 1.0f) : 0.0f;
  float across = r * sqrt(2.0f - r * r);
  vec3 d = vec3(across * cos(turn), across * sin(turn), 1.0f - r * r);
  return vec3(p.x < 0.0f ? -d.x : d.x, p.y < 0.0f ? -d.y : d.y, below < 0.0f ? -d.z : d.z);
}

// From the square without a border into a layer of `resolution` texels a side whose outermost `border` texels repeat what lies across
// the sides, so that filters find their neighbours.
GLSL_FUNCTION vec2 uv_in_layer(vec2 uv, float resolution, float border) {
  return (uv * (resolution - 2.0f * border) + vec2(border)) / resolution;
}

GLSL_FUNCTION vec2 layer_uv(vec3 direction, float resolution, float border) {
  return uv_in_layer(octahedral_uv(direction), resolution, border);
}

GLSL_FUNCTION vec3 layer_direction(vec2 uv, float resolution, float border) {
  return octahedral_direction((uv * resolution - vec2(border)) / (resolution - 2.0f * border));
}
