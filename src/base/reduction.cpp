#include "base/reduction.h"

#include "base/colour.h"

namespace parvis {

Image8 reduced(const Image8& srgb, int n) {
  assert(n >= 1);
  if (n == 1) return srgb;
  const ImageF fine = linear_from_srgb8(srgb);
  ImageF coarse(srgb.width / n, srgb.height / n, srgb.channels);
  const float share = 1.0f / float(n * n);
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x)
      for (int dy = 0; dy < n; ++dy)
        for (int dx = 0; dx < n; ++dx)
          for (int c = 0; c < coarse.channels; ++c)
            coarse.at(x, y)[c] += share * fine.at(n * x + dx, n * y + dy)[c];
  return srgb8_from_linear(coarse);
}

}  // namespace parvis
