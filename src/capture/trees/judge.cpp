#include "capture/trees/judge.h"

#include <algorithm>
#include <cmath>

#include "graphics/reference/metrics.h"

namespace parvis::trees {

ViewErrors& ViewErrors::operator+=(const ViewErrors& other) {
  psnr_db += other.psnr_db, ssim += other.ssim, flip += other.flip, alpha_rmse += other.alpha_rmse;
  return *this;
}

ViewErrors& ViewErrors::operator/=(double count) {
  psnr_db /= count, ssim /= count, flip /= count, alpha_rmse /= count;
  return *this;
}

Image8 over_white(const ImageF& premultiplied) {
  Image8 result(premultiplied.width, premultiplied.height, 3);
  for (std::size_t i = 0; i < result.pixels.size() / 3; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = premultiplied.pixels[4 * i + c] + 1.0f - premultiplied.pixels[4 * i + 3];
      result.pixels[3 * i + c] = std::uint8_t(std::lround(255.0f * std::clamp(value, 0.0f, 1.0f)));
    }
  return result;
}

Image8 over_white(const Image8& straight) {
  Image8 result(straight.width, straight.height, 3);
  for (std::size_t i = 0; i < result.pixels.size() / 3; ++i) {
    const float alpha = float(straight.pixels[4 * i + 3]) / 255.0f;
    for (std::size_t c = 0; c < 3; ++c)
      result.pixels[3 * i + c] =
          std::uint8_t(std::lround(float(straight.pixels[4 * i + c]) * alpha + 255.0f * (1.0f - alpha)));
  }
  return result;
}

Result<ViewErrors> judged(const ImageF& premultiplied, const TreeView& view) {
  const Result<reference::Difference> difference =
      reference::compare(over_white(premultiplied), over_white(view.picture));
  if (!difference) return difference.errors();
  double sum = 0.0;
  for (std::size_t i = 3; i < premultiplied.pixels.size(); i += 4) {
    const double d = double(premultiplied.pixels[i]) - double(view.picture.pixels[i]) / 255.0;
    sum += d * d;
  }
  return ViewErrors{difference->psnr, difference->ssim, difference->flip,
                    std::sqrt(sum / (double(premultiplied.pixels.size()) / 4.0))};
}

}  // namespace parvis::trees
