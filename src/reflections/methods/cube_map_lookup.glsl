// The surroundings in a cube map, as far away as can be.

const float max_taps = 4.0f;  // each way

// Curved mirrors squeeze wide angles into a pixel, and toward the rim in one direction only: lookups spread
// over the pixel's footprint, each as wide as its share, keep what one as wide as the footprint would blur.
// Half a level less keeps edges as sharp as many rays per pixel show them. To be called by all pixels alike:
// `d` is compared between them.
vec3 cube_map_radiance(samplerCube map, float levels, vec3 d, float roughness) {
  vec3 along_x = dFdx(d), along_y = dFdy(d);
  float texels_a_unit = 0.5f * exp2(levels) / max(abs(d.x), max(abs(d.y), abs(d.z)));
  float size_x = texels_a_unit * length(along_x), size_y = texels_a_unit * length(along_y);
  float taps_x = clamp(ceil(size_x), 1.0f, max_taps), taps_y = clamp(ceil(size_y), 1.0f, max_taps);
  float level = log2(max(max(size_x / taps_x, size_y / taps_y), 1e-4f)) - 0.5f + roughness * levels * 0.8f;
  vec3 sum = vec3(0.0f);
  for (float y = 0.5f; y < taps_y; ++y)
    for (float x = 0.5f; x < taps_x; ++x)
      sum += textureLod(map, d + (x / taps_x - 0.5f) * along_x + (y / taps_y - 0.5f) * along_y, level).rgb;
  return sum / (taps_x * taps_y);
}
