// The sky picture with its blurred levels, at texture unit 4.
#include "render/frame.glsl"
#include "shading/sky.glsl"

uniform sampler2D sky_texture;

vec3 sky_radiance(vec3 direction, float roughness) {
  return textureLod(sky_texture, equirect_uv(direction, frame_haze.w), sky_level(roughness, frame_size.z)).rgb;
}
