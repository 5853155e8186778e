// Which of the mirror rays about a pixel fits a surface: pixels that several surfaces share have the ray of
// one of them, and neighbours may have that of another. Layer 0 of rays runs through the middles of pixels;
// layer 1 has the second rays of those that surfaces share.
#include "reflections/methods/ray_difference.glsl"

// The pixel whose ray of the first layer fits best: this one if it fits, else it or one of its four
// neighbours. `least`: its ray_difference.
ivec2 fitting_pixel(vec3 at, vec3 direction, float footprint_m, out float least) {
  ivec2 best = ivec2(gl_FragCoord.xy);
  int tag = surface_object() + 1;
  least = ray_difference(ivec3(best, 0), tag, at, direction, footprint_m);
  for (int i = 0; i < 4 && least > 1.0f; ++i) {
    ivec2 there = pixel_beside(i);
    float difference = ray_difference(ivec3(there, 0), tag, at, direction, footprint_m);
    if (difference < least) least = difference, best = there;
  }
  return best;
}
