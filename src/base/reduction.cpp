#include "base/reduction.h"

#include "base/colour.h"

namespace parvis {

ImageF reduced(const ImageF& fine, int n) {
  assert(n >= 1);
  ImageF coarse(fine.width / n, fine.height / n, fine.channels);
  const float share = 1.0f / float(n * n);
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x)
      for (int dy = 0; dy < n; ++dy)
        for (int dx = 0; dx < n; ++dx)
          for (int c = 0; c < coarse.channels; ++c)
            coarse.at(x, y)[c] += share * fine.at(n * x + dx, n * y + dy)[c];
  return coarse;
}

Image8 reduced(const Image8& srgb, int n) {
  assert(n >= 1);
  return n == 1 ? srgb : srgb8_from_linear(reduced(linear_from_srgb8(srgb), n));
}

}  // namespace parvis
