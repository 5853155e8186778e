// Mirror-like surfaces that show the radiance computed for their pixel; the sky where there is none. Where
// several surfaces share a pixel, the ray of one of them was traced there: the others take the light of the
// neighbouring pixel whose ray runs most like their own, so that outlines stay as smooth as the samples of
// the picture make them.
#include "graphics/render/sky_lookup.glsl"
#include "graphics/render/surface_body.glsl"
#include "graphics/shading/octahedral.glsl"

uniform highp sampler2D base_light;  // alpha: there is some
uniform highp sampler2D coat_light;
uniform highp sampler2D ray_starts;
uniform highp sampler2D ray_directions;

const float alike_turn = 0.3f;        // difference of unit directions
const float alike_footprints = 3.0f;  // between the starts of two rays

vec3 mirrored_direction;
ivec2 light_pixel;  // where the light is read

// How unlike a pixel's ray is: above 1 it belongs to another surface.
float ray_difference(ivec2 pixel, vec3 at, vec3 direction, float footprint_m) {
  vec4 ray = texelFetch(ray_directions, pixel, 0);
  if (int(ray.w) != surface_object() + 1) return 1e9f;
  vec3 turn = (octahedral_direction(ray.xy) - direction) / alike_turn;
  vec3 away = (texelFetch(ray_starts, pixel, 0).xyz - at) / (alike_footprints * footprint_m);
  return dot(turn, turn) + dot(away, away);
}

void look_along(vec3 at, vec3 direction) {
  mirrored_direction = direction;
  light_pixel = ivec2(gl_FragCoord.xy);
  float footprint_m = max(length(dFdx(at)) + length(dFdy(at)), 1e-4f);
  ivec2 here = light_pixel, last = textureSize(ray_directions, 0) - ivec2(1);
  float least = ray_difference(here, at, direction, footprint_m);
  for (int i = 0; i < 4 && least > 1.0f; ++i) {
    ivec2 step = i < 2 ? ivec2(2 * i - 1, 0) : ivec2(0, 2 * i - 5);
    ivec2 there = clamp(here + step, ivec2(0), last);
    float difference = ray_difference(there, at, direction, footprint_m);
    if (difference < least) least = difference, light_pixel = there;
  }
}

vec3 reflected_radiance(float roughness, int layer) {
  vec4 base = texelFetch(base_light, light_pixel, 0);
  if (base.a == 0.0f) return unmapped_radiance(mirrored_direction, roughness);
  return layer == base_layer ? base.rgb : texelFetch(coat_light, light_pixel, 0).rgb;
}
