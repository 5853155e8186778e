#include "capture/photographs/resample.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace parvis::photographs {
namespace {

/// Weights of the four samples around a place at `t` in [0, 1) behind the second.
std::array<float, 4> spline_weights(float t) {
  return {((-0.5f * t + 1.0f) * t - 0.5f) * t, (1.5f * t - 2.5f) * t * t + 1.0f,
          ((-1.5f * t + 2.0f) * t + 0.5f) * t, (0.5f * t - 0.5f) * t * t};
}

}  // namespace

void sample_bicubic(const Image8& rgba, glm::dvec2 pixel, Border border, std::uint8_t* out) {
  const double left = std::floor(pixel.x - 0.5), top = std::floor(pixel.y - 0.5);
  const auto across = spline_weights(float(pixel.x - 0.5 - left)),
             down = spline_weights(float(pixel.y - 0.5 - top));
  float sum[4] = {};
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      const int column = int(left) + i - 1;
      const int x = border == Border::clamped ? std::clamp(column, 0, rgba.width - 1)
                                              : ((column % rgba.width) + rgba.width) % rgba.width;
      const std::uint8_t* p = rgba.at(x, std::clamp(int(top) + j - 1, 0, rgba.height - 1));
      const float weight = across[std::size_t(i)] * down[std::size_t(j)];
      for (int c = 0; c < 4; ++c) sum[c] += weight * float(p[c]);
    }
  for (int c = 0; c < 4; ++c) out[c] = std::uint8_t(std::clamp(sum[c] + 0.5f, 0.0f, 255.0f));
}

}  // namespace parvis::photographs
