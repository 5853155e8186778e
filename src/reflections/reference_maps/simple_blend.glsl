// Simple blending (Meyer and Loscos 2003, sections 3 and 5): two reference maps looked up by the direction
// alone and mixed half and half. Wrong near by, where it shows everything twice; far away a body is too small
// to tell. Needs octahedral.glsl.
uniform highp sampler2DArray map_colours;
#include "reflections/reference_maps/simple_blend_block.glsl"

const float layer_texel_rad =
    3.545f;  // the sphere's area over that of the square: a layer of one texel spans so much

vec3 simple_blend(vec3 direction, float roughness) {
  float spread = max(length(dFdx(direction)), length(dFdy(direction)));
  float level = log2(max(spread * layer_size.x / layer_texel_rad, 1.0f)) + 4.0f * roughness;
  vec2 uv = layer_uv(direction, layer_size.x, layer_size.y);
  return 0.5f * (textureLod(map_colours, vec3(uv, map_pair.x), level).rgb +
                 textureLod(map_colours, vec3(uv, map_pair.y), level).rgb);
}
