// How large a view shows what stands somewhere.
#pragma once

#include <limits>

#include "base/bounds.h"
#include "graphics/render/view.h"

namespace parvis::render {

class ScreenScale {
 public:
  explicit ScreenScale(const View& view)
      : w_row_(glm::transpose(view.clip_from_world)[3]),
        w_per_metre_(glm::length(glm::vec3(w_row_))),
        pixels_at_w_1_(0.5f * float(view.height) *
                       glm::length(glm::vec3(glm::transpose(view.clip_from_world)[1]))) {}

  /// Pixels per metre at the nearest place of a sphere about the box; infinity where the eye may be in it.
  float pixels_per_metre(const Bounds& bounds) const {
    const float min_w = glm::dot(w_row_, glm::vec4(bounds.centre(), 1.0f)) - w_per_metre_ * bounds.radius();
    return min_w > 0.0f ? pixels_at_w_1_ / min_w : std::numeric_limits<float>::infinity();
  }
  /// Pixels per metre at a distance along the view; in a parallel view everywhere, for 1.
  float pixels_per_metre_at(float distance) const { return pixels_at_w_1_ / distance; }

 private:
  glm::vec4 w_row_;
  float w_per_metre_, pixels_at_w_1_;
};

}  // namespace parvis::render
