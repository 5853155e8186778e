// Four samples become a pixel. A sample weighs less the brighter it displays (Karis 2013, Tone Mapping): else
// one highlight of a hundred times white would leave its whole pixel white, and edges against the sky would
// show steps.
#include "graphics/shading/tone_curve.glsl"

uniform highp sampler2DMS samples;
uniform float exposure;
out vec4 radiance;

void main() {
  vec3 sum = vec3(0.0f);
  float weights = 0.0f;
  for (int i = 0; i < 4; ++i) {
    vec3 s = texelFetch(samples, ivec2(gl_FragCoord.xy), i).rgb;
    float weight = sample_weight(exposure * s);
    sum += weight * s;
    weights += weight;
  }
  radiance = vec4(sum / weights, 1.0f);
}
