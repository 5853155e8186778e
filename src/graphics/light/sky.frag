// The sky behind all else, and in views for people the sun's disc.
#include "graphics/render/sky_lookup.glsl"
#include "graphics/shading/beyond_land.glsl"
#include "graphics/shading/sun.glsl"

uniform mat4 world_from_clip;
uniform float shows_sun;  // 1, or 0: a cube face has no texel so small, and the shader of surfaces has the
                          // sun's light already
in vec2 screen_uv;
out vec4 radiance;

void main() {
  vec4 far = world_from_clip * vec4(screen_uv * 2.0f - 1.0f, 1.0f, 1.0f);
  vec3 direction = normalize(far.xyz / far.w - viewer_position.xyz);
  float from_centre = length(direction - frame_to_sun.xyz) / sun_radius_rad;
  float share = clamp((1.0f - from_centre) / max(fwidth(from_centre), 1e-6f) + 0.5f, 0.0f, 1.0f);
  float is_sun = frame_spot.w > -1.5f ? 0.0f : shows_sun;
  vec3 sun = is_sun * share / sun_solid_angle_sr * frame_sun_irradiance.rgb;
  vec3 behind = beyond_land(sky_radiance(direction, 0.0f), direction.z, frame_to_sun.w, frame_haze.rgb);
  radiance = vec4(min(behind + sun, vec3(30000.0f)), 1.0f);  // the target holds half floats
}
