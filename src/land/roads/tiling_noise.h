// Smooth random values over a square that repeats: stains and grains for generated pictures.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/random.h"

namespace parvis::scene {

class TilingNoise {
 public:
  /// `count` x `count` random corners over the square, blended in between.
  TilingNoise(int count, Random& random) : count_(count), corners_(std::size_t(count) * std::size_t(count)) {
    for (float& corner : corners_) corner = random.uniform(-0.5f, 0.5f);
  }

  /// -0.5 .. 0.5 at a place of the square [0, 1)^2.
  float at(glm::vec2 place) const {
    const glm::vec2 scaled = place * float(count_);
    const glm::ivec2 cell(glm::floor(scaled));
    const glm::vec2 f = scaled - glm::vec2(cell), s = f * f * (3.0f - 2.0f * f);
    return glm::mix(glm::mix(corner(cell.x, cell.y), corner(cell.x + 1, cell.y), s.x),
                    glm::mix(corner(cell.x, cell.y + 1), corner(cell.x + 1, cell.y + 1), s.x), s.y);
  }

 private:
  float corner(int x, int y) const {
    return corners_[std::size_t(y % count_) * std::size_t(count_) + std::size_t(x % count_)];
  }

  int count_;
  std::vector<float> corners_;
};

}  // namespace parvis::scene
