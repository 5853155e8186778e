// The reflector as a map of directions from a centre (Estalella and others 2005, section 4.1: position and
// normal cube maps). One octahedral layer holds both: the normal, and how far the surface lies along the
// texel's direction, so that a position is always on its own ray. Four texels around a direction make its
// surface; the first of them also says what kind it is. From the host:
//   vec4 reflector_texel(ivec2 texel)   normal; kind + distance / (2 reach)
// Needs octahedral.glsl and map_window.glsl.

struct MapSample {
  vec3 normal;
  float distance;
  float kind;
};

GLSL_FUNCTION MapSample map_sample(MapWindow window, vec3 direction) {
  vec2 at = window_uv(window, direction) * window.side - vec2(0.5f);
  ivec2 first = clamp(ivec2(floor(at)), ivec2(0), ivec2(int(window.side) - 2));
  vec2 part = clamp(at - vec2(first), vec2(0.0f), vec2(1.0f));
  vec4 t00 = reflector_texel(first), t10 = reflector_texel(first + ivec2(1, 0));
  vec4 t01 = reflector_texel(first + ivec2(0, 1)), t11 = reflector_texel(first + ivec2(1, 1));
  float w11 = part.x * part.y, w10 = part.x - w11, w01 = part.y - w11, w00 = 1.0f - part.x - w01;
  vec4 sum = w00 * t00 + w10 * t10 + w01 * t01 + w11 * t11;
  float distance = w00 * fract(t00.w) + w10 * fract(t10.w) + w01 * fract(t01.w) + w11 * fract(t11.w);
  return MapSample(normalize(vec3(sum.x, sum.y, sum.z)), 2.0f * window.reach * distance, floor(t00.w));
}
