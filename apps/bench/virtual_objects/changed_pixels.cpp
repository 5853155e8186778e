#include "bench/virtual_objects/changed_pixels.h"

#include <algorithm>
#include <cstdlib>

namespace parvis::bench {

Image8 changed_pixels(const Image8& with, const Image8& without, const Image8& mirrors) {
  constexpr int min_change = 3, margin_px = 3;
  Image8 mask(with.width, with.height, 1, 0);
  for (int y = 0; y < with.height; ++y)
    for (int x = 0; x < with.width; ++x) {
      int change = 0;
      for (int c = 0; c < 3; ++c) change = std::max(change, std::abs(with.at(x, y)[c] - without.at(x, y)[c]));
      if (change < min_change || *mirrors.at(x, y) < 128) continue;
      for (int v = std::max(y - margin_px, 0); v <= std::min(y + margin_px, with.height - 1); ++v)
        for (int u = std::max(x - margin_px, 0); u <= std::min(x + margin_px, with.width - 1); ++u)
          if (*mirrors.at(u, v) >= 128) *mask.at(u, v) = 255;
    }
  return mask;
}

}  // namespace parvis::bench
