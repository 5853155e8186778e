#include "graphics/render/picture_scale.h"

#include <algorithm>
#include <cmath>

namespace parvis::render {
namespace {

constexpr double min_pixels = 1.0 / 16.0;  // a quarter as wide and as high: what enlarging bears in motion
// Of what a frame is off, taken back in the next: pixels are not all that it takes.
constexpr double follows = 0.3, follows_far = 0.7, far_off = 1.5;
constexpr double bears = 0.03;  // share of the budget: less is the clock's own spread

}  // namespace

void PictureScale::frame_took(double frame_ms, double budget_ms) {
  if (budget_ms <= 0.0) {
    pixels_ = 1.0;
    return;
  }
  const double over = std::max(frame_ms, 1e-3) / budget_ms;
  const double share = over > far_off ? follows_far : follows;
  if (std::abs(over - 1.0) > bears) pixels_ = std::clamp(pixels_ * std::pow(over, -share), min_pixels, 1.0);
}

glm::ivec2 PictureScale::drawn_size(int width, int height) const {
  const double edge = std::sqrt(pixels_);
  const auto drawn = [&](int pixels) { return std::max(int(std::lround(edge * pixels)), 1); };
  return {drawn(width), drawn(height)};
}

bool PictureScale::is_smallest() const { return pixels_ <= min_pixels; }

}  // namespace parvis::render
