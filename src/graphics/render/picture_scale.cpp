#include "graphics/render/picture_scale.h"

#include <algorithm>
#include <cmath>

namespace parvis::render {
namespace {

constexpr double min_pixels = 0.25;  // half as wide, half as high: what enlarging bears
constexpr double follows =
    0.3;  // of what a frame is off, taken back in the next: pixels are not all that it takes
constexpr double bears = 0.03;  // share of the budget: less is the clock's own spread

}  // namespace

void PictureScale::frame_took(double frame_ms, double budget_ms) {
  if (budget_ms <= 0.0) {
    pixels_ = 1.0;
    return;
  }
  const double over = std::max(frame_ms, 1e-3) / budget_ms;
  if (std::abs(over - 1.0) > bears) pixels_ = std::clamp(pixels_ * std::pow(over, -follows), min_pixels, 1.0);
}

glm::ivec2 PictureScale::drawn_size(int width, int height) const {
  const double edge = std::sqrt(pixels_);
  const auto drawn = [&](int pixels) { return std::max(int(std::lround(edge * pixels)), 1); };
  return {drawn(width), drawn(height)};
}

}  // namespace parvis::render
