// The surroundings in a cube map, as far away as can be.
#include "reflections/methods/footprint_taps.glsl"

// To be called by all pixels alike: `d` is compared between them.
vec3 cube_map_radiance(samplerCube map, float levels, vec3 d, float roughness) {
  vec3 along_x = dFdx(d), along_y = dFdy(d);
  float texels_per_unit = 0.5f * exp2(levels) / max(abs(d.x), max(abs(d.y), abs(d.z)));
  FootprintTaps taps = footprint_taps(along_x, along_y, texels_per_unit);
  float level = taps.level + roughness * levels * 0.8f;
  vec3 sum = vec3(0.0f);
  for (float y = 0.5f; y < taps.count.y; ++y)
    for (float x = 0.5f; x < taps.count.x; ++x)
      sum += textureLod(map, d + (x / taps.count.x - 0.5f) * along_x + (y / taps.count.y - 0.5f) * along_y,
                        level)
                 .rgb;
  return sum / (taps.count.x * taps.count.y);
}
