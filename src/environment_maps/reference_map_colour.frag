// A cube map drawn onto an octahedral layer, four of its texels to one.
#include "shading/octahedral.glsl"

uniform highp samplerCube cube;
uniform vec2 layer_size;  // texels a side, and of its border
in vec2 screen_uv;
out vec4 radiance;

void main() {
  radiance = vec4(textureLod(cube, layer_direction(screen_uv, layer_size.x, layer_size.y), 1.0f).rgb, 1.0f);
}
