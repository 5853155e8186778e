// Which of the mirror rays about a pixel fits a surface: pixels that several surfaces share have the ray of
// one of them, and neighbours may have that of another. Layer 0 of rays runs through the middles of pixels;
// layer 1 has the second rays of those that surfaces share.
uniform highp sampler2DArray ray_starts;
uniform highp sampler2DArray ray_directions;

const float alike_turn = 0.3f;        // difference of unit directions
const float alike_footprints = 3.0f;  // between the starts of two rays

// How unlike a pixel's ray is that of the surface at `at`, which mirrors `direction`: above 1 it belongs to
// another. `pixel.z` is the layer.
float ray_difference(ivec3 pixel, vec3 at, vec3 direction, float footprint_m) {
  vec4 ray = texelFetch(ray_directions, pixel, 0);
  if (int(ray.w) != surface_object() + 1) return 1e9f;
  vec3 turn = (octahedral_direction(ray.xy) - direction) / alike_turn;
  vec3 away = (texelFetch(ray_starts, pixel, 0).xyz - at) / (alike_footprints * footprint_m);
  return dot(turn, turn) + dot(away, away);
}

// The pixel whose ray of the first layer fits best: this one if it fits, else it or one of its four
// neighbours. `least`: its ray_difference.
ivec2 fitting_pixel(vec3 at, vec3 direction, float footprint_m, out float least) {
  ivec2 here = ivec2(gl_FragCoord.xy), last = textureSize(ray_directions, 0).xy - ivec2(1), best = here;
  least = ray_difference(ivec3(here, 0), at, direction, footprint_m);
  for (int i = 0; i < 4 && least > 1.0f; ++i) {
    ivec2 step = i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5);
    ivec2 there = clamp(here + step, ivec2(0), last);
    float difference = ray_difference(ivec3(there, 0), at, direction, footprint_m);
    if (difference < least) least = difference, best = there;
  }
  return best;
}
