// One sample per pixel: where brightness changes, it is averaged along the edge (Lottes 2009, FXAA, the
// variant for consoles), each sample weighted as in resolve.frag. A pixel that is much brighter than
// all of its neighbours, a highlight of something thin or sky between leaves, becomes their mean.
#include "graphics/shading/tone_curve.glsl"

uniform sampler2D samples;
uniform vec2 drawn;  // pixels: the first of the texture's
uniform float exposure;
uniform bool has_ink;  // its alpha is the fraction of a sample that no ink covers
out vec4 radiance;

vec4 sample_at(vec2 pixel) {
  return textureLod(samples, clamp(pixel, vec2(0.5f), drawn - 0.5f) / vec2(textureSize(samples, 0)), 0.0f);
}

float brightness(vec4 s) {
  return sqrt(dot(tone_mapped(exposure * s.rgb), vec3(0.2126f, 0.7152f, 0.0722f))) * (has_ink ? s.a : 1.0f);
}

vec4 mean_of(vec2 a, vec2 b) {
  vec4 first = sample_at(a), second = sample_at(b);
  float first_weight = sample_weight(exposure * first.rgb),
        second_weight = sample_weight(exposure * second.rgb);
  return (first_weight * first + second_weight * second) / (first_weight + second_weight);
}

void main() {
  const float longest = 8.0f, min_step = 1.0f / 24.0f, level_step = 1.0f / 8.0f, lone = 1.4f;
  vec2 at = gl_FragCoord.xy;
  vec4 here = sample_at(at);
  float middle = brightness(here);
  float nw = brightness(sample_at(at + vec2(-0.5f, 0.5f))), ne = brightness(sample_at(at + vec2(0.5f, 0.5f)));
  float sw = brightness(sample_at(at + vec2(-0.5f, -0.5f))),
        se = brightness(sample_at(at + vec2(0.5f, -0.5f)));
  float least = min(middle, min(min(nw, ne), min(sw, se))), most = max(middle, max(max(nw, ne), max(sw, se)));
  vec4 smoothed = here;
  vec2 step = vec2(1.0f, 0.0f);
  float beside = max(max(brightness(sample_at(at + step)), brightness(sample_at(at - step))),
                     max(brightness(sample_at(at + step.yx)), brightness(sample_at(at - step.yx))));
  if (middle > lone * beside) {
    smoothed = 0.5f * (mean_of(at + step, at - step) + mean_of(at + step.yx, at - step.yx));
  } else if (most - least > max(min_step, level_step * most)) {
    vec2 along = vec2(sw + se - nw - ne, ne + se - nw - sw);
    along /= min(abs(along.x), abs(along.y)) + max((nw + ne + sw + se) / 32.0f, 1.0f / 128.0f);
    along = clamp(along, vec2(-longest), vec2(longest));
    vec4 near = mean_of(at - along / 6.0f, at + along / 6.0f);
    vec4 far = 0.5f * (near + mean_of(at - 0.5f * along, at + 0.5f * along));
    float reached = brightness(far);
    smoothed = reached < least || reached > most ? near : far;
  }
  radiance = vec4(smoothed.rgb, has_ink ? smoothed.a : 1.0f);
}
