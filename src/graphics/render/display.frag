// From radiance to the screen: exposure, tone curve, sRGB.
#include "graphics/shading/srgb.glsl"
#include "graphics/shading/tone_curve.glsl"

uniform sampler2D radiance_texture;
uniform vec2 drawn;  // pixels: the first of the texture's
uniform float exposure;
in vec2 screen_uv;
out vec4 colour;

void main() {
  vec2 pixel = clamp(screen_uv * drawn, vec2(0.5f), drawn - 0.5f);
  vec3 exposed =
      exposure * textureLod(radiance_texture, pixel / vec2(textureSize(radiance_texture, 0)), 0.0f).rgb;
  colour = vec4(srgb_of_linear(tone_mapped(exposed)), 1.0f);
}
