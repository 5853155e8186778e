#include "graphics/reference/filter.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"

namespace parvis::reference {
namespace {

template <class Source>
ImageF filtered_along(const ImageF& image, const Kernel& kernel, const Source& source) {
  ImageF result(image.width, image.height, image.channels);
  const int radius = int(kernel.size() / 2);
  parallel_for(std::size_t(image.height), [&](std::size_t row) {
    const int y = int(row);
    for (int x = 0; x < image.width; ++x)
      for (int k = -radius; k <= radius; ++k) {
        const float* in = source(x, y, k);
        float* out = result.at(x, y);
        for (int c = 0; c < image.channels; ++c) out[c] += kernel[std::size_t(k + radius)] * in[c];
      }
  });
  return result;
}

}  // namespace

ImageF filtered(const ImageF& image, const Kernel& along_x, const Kernel& along_y) {
  const ImageF rows = filtered_along(image, along_x, [&](int x, int y, int k) {
    return image.at(std::clamp(x + k, 0, image.width - 1), y);
  });
  return filtered_along(
      rows, along_y, [&](int x, int y, int k) { return rows.at(x, std::clamp(y + k, 0, image.height - 1)); });
}

Kernel gaussian(float sigma, int radius) {
  Kernel kernel(std::size_t(2 * radius + 1));
  float sum = 0.0f;
  for (int x = -radius; x <= radius; ++x) {
    kernel[std::size_t(x + radius)] = std::exp(-float(x * x) / (2.0f * sigma * sigma));
    sum += kernel[std::size_t(x + radius)];
  }
  for (float& value : kernel) value /= sum;
  return kernel;
}

}  // namespace parvis::reference
