// The faces of one level of a cube map, side by side, blurred for the level's roughness. Each direction of
// the lobe is looked up as wide as its share (Colbert and Krivanek 2007).
#include "reflections/methods/lobe_levels.glsl"

uniform highp samplerCube cube;
uniform float roughness;
in vec2 screen_uv;
out vec4 radiance;

const int samples = 32;

// OpenGL 4.5, table 8.19, read backward.
vec3 direction_in_face(int face, vec2 st) {
  if (face == 0) return vec3(1.0f, -st.y, -st.x);
  if (face == 1) return vec3(-1.0f, -st.y, st.x);
  if (face == 2) return vec3(st.x, 1.0f, st.y);
  if (face == 3) return vec3(st.x, -1.0f, -st.y);
  if (face == 4) return vec3(st.x, -st.y, 1.0f);
  return vec3(-st.x, -st.y, -1.0f);
}

void main() {
  float face = min(floor(6.0f * screen_uv.x), 5.0f);
  vec2 uv = vec2(6.0f * screen_uv.x - face, screen_uv.y);
  vec3 normal = normalize(direction_in_face(int(face), 2.0f * uv - 1.0f));
  float texels_per_unit = float(textureSize(cube, 0).x) * sqrt(6.0f / 12.5663706f);
  vec3 sum = vec3(0.0f);
  float count = 0.0f;
  for (int i = 0; i < samples; ++i) {
    vec4 at = lobe_sample(normal, roughness, i, samples);
    if (dot(normal, at.xyz) <= 0.0f) continue;
    sum += textureLod(cube, at.xyz, log2(max(texels_per_unit * sqrt(at.w), 1.0f)) + 0.5f).rgb;
    count += 1.0f;
  }
  radiance = vec4(sum / max(count, 1.0f), 1.0f);
}
