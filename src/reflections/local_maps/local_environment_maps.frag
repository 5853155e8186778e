// Mirror-like surfaces that look their surroundings up in the local map of their body, as if it were
// infinitely far; bodies without one look simply blended reference maps up.
#include "graphics/render/sky_lookup.glsl"
#include "graphics/shading/octahedral.glsl"
#include "reflections/local_maps/local_map_faces.glsl"
#include "reflections/methods/footprint_taps.glsl"
#include "reflections/reference_maps/simple_blend.glsl"
#include "graphics/render/mirrored_direction.glsl"
#include "graphics/render/surface_body.glsl"

uniform highp sampler2D local_maps;
#include "reflections/local_maps/local_map_block.glsl"

const float coarsest_level = 3.0f;  // as far as the tiles' borders reach

vec3 local_radiance(vec3 direction, float level) {
  vec2 texel = local_map.xy + texel_on_tiles(direction, local_map.z, local_border);
  return textureLod(local_maps, texel / picture_size, min(level, coarsest_level)).rgb;
}

vec3 reflected_radiance(float roughness, int layer) {
  vec3 direction = mirrored_direction;
  if (local_map.z < 1.0f) return simple_blend(direction, roughness);
  vec3 along_x = dFdx(direction), along_y = dFdy(direction);
  float reach = max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
  FootprintTaps taps = footprint_taps(along_x, along_y, (0.5f * local_map.z - local_border) / reach);
  float level = taps.level + 5.0f * roughness;
  vec3 sum = vec3(0.0f);
  for (float y = 0.5f; y < taps.count.y; ++y)
    for (float x = 0.5f; x < taps.count.x; ++x)
      sum += local_radiance(
          direction + (x / taps.count.x - 0.5f) * along_x + (y / taps.count.y - 0.5f) * along_y, level);
  return sum / (taps.count.x * taps.count.y);
}
