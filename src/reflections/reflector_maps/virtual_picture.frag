// Resolves the four samples of a pixel like those of the main view (render/resolve.frag). Samples that no
// patch has marked, of alpha below 0, do not count: on a reflector's outline the pixel holds what the
// reflector shows within it.
#include "graphics/shading/tone_curve.glsl"

uniform highp sampler2DMS samples;
uniform float exposure;
out vec4 radiance;  // premultiplied by alpha, the share of the reflector that is covered

void main() {
  vec4 sum = vec4(0.0f);
  float marked = 0.0f, covered = 0.0f;
  for (int i = 0; i < 4; ++i) {
    vec4 s = texelFetch(samples, ivec2(gl_FragCoord.xy), i);
    float weight = sample_weight(exposure * s.rgb);
    bool is_marked = s.a >= 0.0f;
    marked += is_marked ? 1.0f : 0.0f;
    covered += is_marked ? s.a : 0.0f;
    sum += is_marked ? weight * s : vec4(0.0f);
  }
  radiance = covered > 0.0f ? (covered / marked) * vec4(sum.rgb / sum.a, 1.0f) : vec4(0.0f);
}
