// Directions for tests and benches.
#pragma once

#include <glm/glm.hpp>

#include "base/random.h"

namespace parvis {

/// A uniformly distributed unit vector.
inline glm::vec3 random_direction(Random& random) {
  glm::vec3 d;
  do d = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  while (glm::length(d) > 1.0f || glm::length(d) < 0.01f);
  return glm::normalize(d);
}

}  // namespace parvis
