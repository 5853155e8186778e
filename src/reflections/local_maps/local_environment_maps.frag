// Mirror-like surfaces that look their surroundings up in the local map of their body, as if it were
// infinitely far; bodies without one look simply blended reference maps up.
#include "graphics/render/sky_lookup.glsl"
#include "graphics/shading/octahedral.glsl"
#include "reflections/local_maps/local_map_faces.glsl"
#include "reflections/reference_maps/simple_blend.glsl"
#include "graphics/render/surface_body.glsl"

uniform highp sampler2D local_maps;
uniform vec3 local_map;     // south-west corner in texels, texels a side of a tile; 0: there is none
uniform vec2 picture_size;  // of all local maps
uniform float local_border;

const float max_taps = 4.0f;        // each way
const float coarsest_level = 3.0f;  // as far as the tiles' borders reach

vec3 local_radiance(vec3 direction, float level) {
  vec2 texel = local_map.xy + texel_on_tiles(direction, local_map.z, local_border);
  return textureLod(local_maps, texel / picture_size, min(level, coarsest_level)).rgb;
}

vec3 mirrored_direction;

void look_along(vec3 at, vec3 direction) { mirrored_direction = direction; }

// Curved mirrors squeeze wide angles into a pixel, and toward the rim in one direction only: lookups spread
// over the pixel's footprint, each as wide as its share, keep what one as wide as the footprint would blur.
vec3 reflected_radiance(float roughness, int layer) {
  vec3 direction = mirrored_direction;
  if (local_map.z < 1.0f) return simple_blend(direction, roughness);
  vec3 along_x = dFdx(direction), along_y = dFdy(direction);
  float reach = max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
  float texels_a_unit = (0.5f * local_map.z - local_border) / reach;
  float size_x = texels_a_unit * length(along_x), size_y = texels_a_unit * length(along_y);
  float taps_x = clamp(ceil(size_x), 1.0f, max_taps), taps_y = clamp(ceil(size_y), 1.0f, max_taps);
  float level = log2(max(max(size_x / taps_x, size_y / taps_y), 1e-4f)) - 0.5f + 5.0f * roughness;
  vec3 sum = vec3(0.0f);
  for (float y = 0.5f; y < taps_y; ++y)
    for (float x = 0.5f; x < taps_x; ++x)
      sum += local_radiance(direction + (x / taps_x - 0.5f) * along_x + (y / taps_y - 0.5f) * along_y, level);
  return sum / (taps_x * taps_y);
}
