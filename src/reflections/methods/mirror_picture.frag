// Mirror-like surfaces that show the radiance computed for their pixel; the sky where there is none. Where
// several surfaces share a pixel, the ray of one of them was traced there: the others take the light of the
// neighbouring pixel whose ray runs most like their own, or that of the pixel's second ray, so that outlines
// stay as smooth as the samples of the picture make them.
#include "graphics/render/sky_lookup.glsl"
#include "graphics/render/surface_body.glsl"
#include "graphics/shading/octahedral.glsl"
#include "reflections/methods/fitting_ray.glsl"

uniform highp sampler2DArray base_light;  // alpha: there is some
uniform highp sampler2DArray coat_light;
uniform bool has_second_rays;  // pixels have two layers of light

vec3 mirrored_direction;
ivec3 light_pixel;  // where the light is read; z: the layer

void look_along(vec3 at, vec3 direction) {
  mirrored_direction = direction;
  float footprint_m = max(length(dFdx(at)) + length(dFdy(at)), 1e-4f), least;
  light_pixel = ivec3(fitting_pixel(at, direction, footprint_m, least), 0);
  if (least <= 1.0f || !has_second_rays) return;
  ivec3 second = ivec3(ivec2(gl_FragCoord.xy), 1);
  // Without any ray in the first layer, the light of a nearer surface stands in.
  bool has_none = texelFetch(ray_directions, light_pixel, 0).w == 0.0f;
  if (has_none || ray_difference(second, surface_object() + 1, at, direction, footprint_m) < least)
    light_pixel = second;
}

vec3 reflected_radiance(float roughness, int layer) {
  vec4 base = texelFetch(base_light, light_pixel, 0);
  if (base.a == 0.0f) return unmapped_radiance(mirrored_direction, roughness);
  return layer == base_layer ? base.rgb : texelFetch(coat_light, light_pixel, 0).rgb;
}
