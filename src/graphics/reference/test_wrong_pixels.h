// Pixels of a picture that are off from a true one, for the tests of light and shadows.
#pragma once

#include <cmath>

#include "base/image.h"

namespace parvis::reference {

struct WrongPixels {
  int wrong = 0, count = 0;
  double percent() const { return 100.0 * wrong / count; }
};

/// Counts pixels, among those for which `counts(x, y)` is true, whose green is off by more than `share` of
/// the true value, plus `floor`.
template <class Counts>
WrongPixels wrong_pixels(const ImageF& picture, const ImageF& truth, float share, float floor,
                         const Counts& counts) {
  WrongPixels pixels;
  for (int y = 0; y < truth.height; ++y)
    for (int x = 0; x < truth.width; ++x) {
      if (!counts(x, y)) continue;
      const float expected = truth.at(x, y)[1];
      ++pixels.count;
      pixels.wrong += std::abs(picture.at(x, y)[1] - expected) > share * expected + floor;
    }
  return pixels;
}

/// Percent of all pixels, off by more than a tenth.
inline double wrong_percent(const ImageF& picture, const ImageF& truth, float floor = 0.01f) {
  return wrong_pixels(picture, truth, 0.1f, floor, [](int, int) { return true; }).percent();
}

}  // namespace parvis::reference
