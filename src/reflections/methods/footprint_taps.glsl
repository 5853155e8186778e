// Anisotropic filtering of a picture of all directions. Curved mirrors compress wide angles into a pixel, and
// toward the rim in one direction only: lookups spread over the pixel's footprint, each as wide as its share,
// keep what one as wide as the footprint would blur.

const float max_taps = 4.0f;  // per direction

struct FootprintTaps {
  vec2 count;   // along x and y of the screen
  float level;  // of each; half a level less keeps edges as sharp as many rays per pixel show them
};

// `along_x`, `along_y`: by what the direction changes to the next pixel.
FootprintTaps footprint_taps(vec3 along_x, vec3 along_y, float texels_per_unit) {
  vec2 size = texels_per_unit * vec2(length(along_x), length(along_y));
  vec2 count = clamp(ceil(size), vec2(1.0f), vec2(max_taps));
  return FootprintTaps(count, log2(max(max(size.x / count.x, size.y / count.y), 1e-4f)) - 0.5f);
}
