// Four samples become a pixel. A sample weighs less the brighter it displays (Karis 2013, Tone Mapping): else
// one highlight of a hundred times white would leave its whole pixel white, and edges against the sky would
// show steps.
#include "graphics/shading/tone_curve.glsl"

uniform highp sampler2DMS samples;
uniform float exposure;
uniform bool has_ink;  // its alpha is the share of a sample that no ink covers
out vec4 radiance;

void main() {
  vec3 sum = vec3(0.0f);
  float bare = 0.0f;
  float weights = 0.0f;
  for (int i = 0; i < 4; ++i) {
    vec4 s = texelFetch(samples, ivec2(gl_FragCoord.xy), i);
    float weight = sample_weight(exposure * s.rgb);
    sum += weight * s.rgb;
    bare += 0.25f * s.a;
    weights += weight;
  }
  radiance = vec4(sum / weights, has_ink ? bare : 1.0f);
}
