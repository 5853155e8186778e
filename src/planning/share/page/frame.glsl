// What all surfaces and the sky of a picture share: the light of the moment, and how it is displayed.

uniform vec3 to_sun, sun_irradiance, sky_sh[9], haze_radiance;
uniform float haze_per_m, exposure;
uniform vec4 frame_realism;
uniform sampler2D sky_before, sky_after;  // of the moments before and after
uniform float sky_share;                  // of the later one
uniform vec4 sky_levels;  // levels of each sky, those left out above the sharpest: x, y before; z, w after
uniform vec2 sky_heading;
uniform highp sampler3D visibility_map, bounced_map;
uniform vec4 visibility_origin, bounced_origin;  // w: lift
uniform vec3 visibility_size, bounced_size;
uniform float bounced_layers, bounced_scale;
uniform highp sampler2DShadow far_shadow, near_shadow;
uniform mat4 far_uvz, near_uvz;
uniform vec2 shadow_texel_m;
uniform float shadow_texel_uv;

float shadow_compare(int map, vec3 uvz) {
  return map == shadow_far_map ? texture(far_shadow, uvz) : texture(near_shadow, uvz);
}

vec3 sky_radiance(vec3 direction, float roughness) {
  vec3 before = textureLod(sky_before, equirect_uv(direction, sky_heading.x),
                           max(sky_level(roughness, sky_levels.x) - sky_levels.y, 0.0))
                    .rgb;
  if (sky_share <= 0.0) return before;
  return mix(before,
             textureLod(sky_after, equirect_uv(direction, sky_heading.y),
                        max(sky_level(roughness, sky_levels.z) - sky_levels.w, 0.0))
                 .rgb,
             sky_share);
}

vec3 displayed(vec3 radiance) {
  vec3 shown = srgb_of_linear(tone_mapped(exposure * radiance));
  return frame_realism.w > 0.0 ? washed(shown, frame_realism.w) : shown;
}
