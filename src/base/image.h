// Pictures as flat arrays: row by row from the top left, channels interleaved, pixel centres at +0.5.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace parvis {

/// `channels` is 1 (grey), 3 (RGB) or 4 (RGBA, alpha not premultiplied).
template <class T>
struct BasicImage {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<T> pixels;  ///< width * height * channels values

  BasicImage() = default;
  BasicImage(int w, int h, int c, T fill = T{})
      : width(w), height(h), channels(c), pixels(std::size_t(w) * std::size_t(h) * std::size_t(c), fill) {}

  bool empty() const { return pixels.empty(); }
  T* at(int x, int y) { return pixels.data() + offset(x, y); }
  const T* at(int x, int y) const { return pixels.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    assert(x >= 0 && x < width && y >= 0 && y < height);
    return (std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channels);
  }
};

using Image8 = BasicImage<std::uint8_t>;  ///< sRGB colour, or plain data (normals, masks)
using ImageF = BasicImage<float>;         ///< linear Rec. 709, or plain data (depth, radiance)

}  // namespace parvis
