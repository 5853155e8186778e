// The sky behind all else.
#include "graphics/render/sky_lookup.glsl"

uniform mat4 world_from_clip;
in vec2 screen_uv;
out vec4 radiance;

void main() {
  vec4 far = world_from_clip * vec4(screen_uv * 2.0f - 1.0f, 1.0f, 1.0f);
  radiance = vec4(sky_radiance(normalize(far.xyz / far.w - viewer_position.xyz), 0.0f), 1.0f);
}
