#include "capture/trees/judge.h"

#include <cmath>

#include "base/colour.h"
#include "graphics/reference/metrics.h"

namespace parvis::trees {

ViewErrors& ViewErrors::operator+=(const ViewErrors& other) {
  psnr_db += other.psnr_db, ssim += other.ssim, flip += other.flip, alpha_rmse += other.alpha_rmse;
  silhouette_iou += other.silhouette_iou;
  return *this;
}

ViewErrors& ViewErrors::operator/=(double count) {
  psnr_db /= count, ssim /= count, flip /= count, alpha_rmse /= count;
  silhouette_iou /= count;
  return *this;
}

Image8 over_white(const ImageF& premultiplied) {
  ImageF light(premultiplied.width, premultiplied.height, 3);
  for (std::size_t i = 0; i < light.pixels.size() / 3; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      light.pixels[3 * i + c] = premultiplied.pixels[4 * i + c] + 1.0f - premultiplied.pixels[4 * i + 3];
  return srgb8_from_linear(light);
}

Image8 over_white(const Image8& straight) {
  ImageF light = linear_from_srgb8(straight);
  for (std::size_t i = 0; i < light.pixels.size(); i += 4)
    for (std::size_t c = 0; c < 3; ++c) light.pixels[i + c] *= light.pixels[i + 3];
  return over_white(light);
}

Result<ViewErrors> judged(const ImageF& premultiplied, const TreeView& view) {
  const Result<reference::Difference> difference =
      reference::compare(over_white(premultiplied), over_white(view.picture));
  if (!difference) return difference.errors();
  double sum = 0.0;
  std::size_t both = 0, either = 0;
  for (std::size_t i = 3; i < premultiplied.pixels.size(); i += 4) {
    const double d = double(premultiplied.pixels[i]) - double(view.picture.pixels[i]) / 255.0;
    sum += d * d;
    const bool is_shown = premultiplied.pixels[i] >= 0.5f, is_true = view.picture.pixels[i] > 127;
    both += is_shown && is_true, either += is_shown || is_true;
  }
  return ViewErrors{difference->psnr, difference->ssim, difference->flip,
                    std::sqrt(sum / (double(premultiplied.pixels.size()) / 4.0)),
                    either > 0 ? double(both) / double(either) : 1.0};
}

}  // namespace parvis::trees
