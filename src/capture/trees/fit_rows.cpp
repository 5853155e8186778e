#include "capture/trees/fit_rows.h"

#include <algorithm>

#include "base/colour.h"

namespace parvis::trees {

FitRows FitRows::of(const TreeView& view, int factor, const machines::Processes& processes) {
  FitRows result{reduced(view.camera, factor), {}, processes.rank(), processes.count()};
  const int width = result.camera.width,
            rows = std::max(result.camera.height - result.first + result.apart - 1, 0) / result.apart;
  result.rgba = ImageF(width, rows, 4);
  const Image8& picture = view.picture;
  for (int i = 0; i < rows; ++i) {
    const int top = result.row(i) * factor;
    Image8 strip(picture.width, std::min(factor, picture.height - top), 4);
    std::copy_n(picture.at(0, top), strip.pixels.size(), strip.pixels.begin());
    const ImageF linear = linear_from_srgb8(strip);
    for (int x = 0; x < width; ++x) {
      glm::vec4 sum(0.0f);
      int count = 0;
      for (int v = 0; v < linear.height; ++v)
        for (int u = x * factor; u < std::min((x + 1) * factor, linear.width); ++u, ++count) {
          const float* p = linear.at(u, v);
          sum += glm::vec4(p[3] * glm::vec3(p[0], p[1], p[2]), p[3]);
        }
      for (int c = 0; c < 4; ++c) result.rgba.at(x, i)[c] = sum[c] / float(count);
    }
  }
  return result;
}

}  // namespace parvis::trees
