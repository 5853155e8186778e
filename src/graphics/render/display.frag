// From radiance to the screen: exposure, tone curve, sRGB; of a sketch washes on paper, and ink over them.
#include "graphics/shading/srgb.glsl"
#include "graphics/shading/surface.glsl"
#include "graphics/shading/realism.glsl"
#include "graphics/shading/tone_curve.glsl"

uniform sampler2D radiance_texture;
uniform vec2 drawn;  // pixels: the first of the texture's
uniform float exposure;
uniform float paper_share;  // realism_at
in vec2 screen_uv;
out vec4 colour;

void main() {
  vec2 pixel = clamp(screen_uv * drawn, vec2(0.5f), drawn - 0.5f);
  vec4 shown = textureLod(radiance_texture, pixel / vec2(textureSize(radiance_texture, 0)), 0.0f);
  vec3 displayed = srgb_of_linear(tone_mapped(exposure * shown.rgb));
  if (paper_share > 0.0f) displayed = washed(displayed, paper_share);
  const vec3 ink = vec3(0.13f, 0.12f, 0.13f);
  colour = vec4(mix(ink, displayed, shown.a), 1.0f);
}
