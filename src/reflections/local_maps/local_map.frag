// A local map's texels (Meyer and Loscos 2003, section 4.1): what the two reference maps show of the point,
// blended.
#include "graphics/shading/octahedral.glsl"

uniform highp sampler2DArray map_colours;
#include "reflections/local_maps/picture_block.glsl"

in vec3 from_a;
in vec3 from_b;
in float share_of_a;
in float is_seen;
flat in vec3 maps_and_span;
out vec4 radiance;

const float texel_rad =
    3.545f;  // the sphere's area over that of the square: a layer of one texel spans so much

vec3 colour_of(float map, vec3 from_place) {
  float distance_m = length(from_place);
  float texels = maps_and_span.z / gl_FragCoord.w / distance_m * layer_size.x / texel_rad;
  vec3 uv = vec3(layer_uv(from_place / distance_m, layer_size.x, layer_size.y), map);
  return textureLod(map_colours, uv, log2(max(texels, 1.0f))).rgb;
}

void main() {
#if defined(SHOWS_MESH)
  radiance = vec4(1.0f, 0.0f, 0.0f, 1.0f);
#elif defined(SHOWS_WEIGHTS)
  radiance = is_seen > 0.0f ? vec4(share_of_a, 1.0f - share_of_a, 0.0f, 1.0f) : vec4(0.0f, 0.0f, 1.0f, 1.0f);
#else
  vec3 sum = vec3(0.0f);
  if (share_of_a > 0.0f) sum += share_of_a * colour_of(maps_and_span.x, from_a);
  if (share_of_a < 1.0f) sum += (1.0f - share_of_a) * colour_of(maps_and_span.y, from_b);
  radiance = vec4(sum, 1.0f);
#endif
}
