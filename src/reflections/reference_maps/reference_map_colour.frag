// A cube map drawn onto an octahedral layer: of each texel the mean of a few points, each as sharp as the
// cube map is.
#include "graphics/shading/octahedral.glsl"

uniform highp samplerCube cube;
uniform vec2 layer_size;  // texels per side, and of its border
in vec2 screen_uv;
out vec4 radiance;

const float points_per_side = 2.0f;

void main() {
  vec3 sum = vec3(0.0f);
  for (float y = 0.5f; y < points_per_side; ++y)
    for (float x = 0.5f; x < points_per_side; ++x) {
      vec2 uv = screen_uv + (vec2(x, y) / points_per_side - 0.5f) / layer_size.x;
      sum += textureLod(cube, layer_direction(uv, layer_size.x, layer_size.y), 0.0f).rgb;
    }
  radiance = vec4(sum / (points_per_side * points_per_side), 1.0f);
}
