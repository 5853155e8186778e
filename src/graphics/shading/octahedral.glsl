// Directions on a square (Meyer and others 2010, octahedral unit vectors): the upper hemisphere is the inner
// diamond, the lower one folded out into the corners. One map of a layer then holds what a cube map holds in
// six faces.

GLSL_FUNCTION vec2 octahedral_uv(vec3 direction) {
  vec3 d = direction / (abs(direction.x) + abs(direction.y) + abs(direction.z));
  vec2 p = vec2(d.x, d.y);
  if (d.z < 0.0f)
    p = vec2((1.0f - abs(d.y)) * (d.x >= 0.0f ? 1.0f : -1.0f),
             (1.0f - abs(d.x)) * (d.y >= 0.0f ? 1.0f : -1.0f));
  return 0.5f * p + vec2(0.5f);
}

// A unit vector. Beyond the square's sides the map goes on as it does across them: turned round by half about
// their middles.
GLSL_FUNCTION vec3 octahedral_direction(vec2 uv) {
  vec2 p = 2.0f * uv - vec2(1.0f);
  if (abs(p.x) > 1.0f) p = vec2(2.0f * sign(p.x) - p.x, -p.y);
  if (abs(p.y) > 1.0f) p = vec2(-p.x, 2.0f * sign(p.y) - p.y);
  float z = 1.0f - abs(p.x) - abs(p.y);
  if (z < 0.0f)
    p = vec2((1.0f - abs(p.y)) * (p.x >= 0.0f ? 1.0f : -1.0f),
             (1.0f - abs(p.x)) * (p.y >= 0.0f ? 1.0f : -1.0f));
  return normalize(vec3(p.x, p.y, z));
}

// From the square without a border into a layer of `resolution` texels per side whose outermost `border`
// texels repeat what lies across the sides, so that filters find their neighbours.
GLSL_FUNCTION vec2 uv_in_layer(vec2 uv, float resolution, float border) {
  return (uv * (resolution - 2.0f * border) + vec2(border)) / resolution;
}

GLSL_FUNCTION vec2 layer_uv(vec3 direction, float resolution, float border) {
  return uv_in_layer(octahedral_uv(direction), resolution, border);
}

GLSL_FUNCTION vec3 layer_direction(vec2 uv, float resolution, float border) {
  return octahedral_direction((uv * resolution - vec2(border)) / (resolution - 2.0f * border));
}
