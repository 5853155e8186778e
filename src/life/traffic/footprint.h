// The ground that a vehicle covers: a rectangle in plan.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace parvis::traffic {

struct Footprint {
  glm::vec2 centre{0.0f};
  glm::vec2 forward{1.0f, 0.0f};  ///< unit
  float half_length_m = 0.0f;
  float half_width_m = 0.0f;
};

/// Whether two rectangles overlap: no side of either separates them.
inline bool overlap(const Footprint& a, const Footprint& b) {
  const glm::vec2 between = b.centre - a.centre;
  const auto reach = [](const Footprint& f, glm::vec2 axis) {
    const glm::vec2 left(-f.forward.y, f.forward.x);
    return f.half_length_m * std::abs(glm::dot(f.forward, axis)) +
           f.half_width_m * std::abs(glm::dot(left, axis));
  };
  for (const glm::vec2 forward : {a.forward, b.forward})
    for (const glm::vec2 axis : {forward, glm::vec2(-forward.y, forward.x)})
      if (std::abs(glm::dot(between, axis)) >= reach(a, axis) + reach(b, axis)) return false;
  return true;
}

}  // namespace parvis::traffic
