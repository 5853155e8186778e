// The surroundings in a cube map, as far away as can be.
#include "reflections/methods/footprint_taps.glsl"
#include "reflections/methods/lobe_levels.glsl"

// To be called by all pixels alike: `d` is compared between them. The level is the lobe's, where it is wider
// than the pixel's footprint.
vec3 cube_map_radiance(samplerCube map, float levels, vec3 d, float roughness) {
  vec3 along_x = dFdx(d), along_y = dFdy(d);
  float lobe_level = max(level_of_roughness(levels, roughness), 0.0f);
  float texels_per_unit = 0.5f * exp2(levels - lobe_level) / max(abs(d.x), max(abs(d.y), abs(d.z)));
  FootprintTaps taps = footprint_taps(along_x, along_y, texels_per_unit);
  float level = lobe_level + max(taps.level, 0.0f);
  vec3 sum = vec3(0.0f);
  for (float y = 0.5f; y < taps.count.y; ++y)
    for (float x = 0.5f; x < taps.count.x; ++x)
      sum += textureLod(map, d + (x / taps.count.x - 0.5f) * along_x + (y / taps.count.y - 0.5f) * along_y,
                        level)
                 .rgb;
  return sum / (taps.count.x * taps.count.y);
}
