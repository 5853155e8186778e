// Mirror-like surfaces that show the radiance computed for their pixel; the sky where there is none.
#include "graphics/render/sky_lookup.glsl"
#include "graphics/render/mirrored_direction.glsl"
#include "graphics/render/surface_body.glsl"

uniform highp sampler2D base_light;  // alpha: there is some
uniform highp sampler2D coat_light;

vec3 reflected_radiance(float roughness, int layer) {
  vec4 base = texelFetch(base_light, ivec2(gl_FragCoord.xy), 0);
  if (base.a == 0.0f)
    return sky_share_of_direction(surface_sky_cell, mirrored_direction) *
           sky_radiance(mirrored_direction, roughness);
  return layer == base_layer ? base.rgb : texelFetch(coat_light, ivec2(gl_FragCoord.xy), 0).rgb;
}
