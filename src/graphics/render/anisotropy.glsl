// The base colour of a surface seen at a grazing angle. Where hardware has no anisotropic lookup that is
// worth its time, a few trilinear ones along the longer side of the pixel's footprint stand in for it.
#include "graphics/render/material.glsl"

// `along_x`, `along_y`: by how much `at` changes to the neighbouring pixels, were the surface flat.
vec4 base_colour_at(vec2 at, vec2 along_x, vec2 along_y) {
#ifdef ANISOTROPY_BY_TAPS
  vec2 size = vec2(textureSize(base_colour_texture, 0));
  float length_x = length(along_x * size), length_y = length(along_y * size);
  vec2 longer = length_x > length_y ? along_x : along_y;
  float maximum = max(length_x, length_y);
  // Footprints narrower than a texel need no more taps than one as wide.
  int taps = int(clamp(ceil(maximum / max(min(length_x, length_y), 1.0f)), 1.0f, 8.0f));
  float level = log2(max(maximum / float(taps), 1e-4f));
  vec4 sum = vec4(0.0f);
  int i = 0;
  do {  // software renderers run a loop whose condition comes first once more than it has rounds
    sum += textureLod(base_colour_texture, at + ((float(i) + 0.5f) / float(taps) - 0.5f) * longer, level);
  } while (++i < taps);
  return sum / float(taps);
#else
  return textureGrad(base_colour_texture, at, along_x, along_y);
#endif
}
