// An ellipsoid about the origin as a reflector, from its formula: what searches are judged on without the
// error of maps.
#pragma once

#include <glm/glm.hpp>
#include <utility>

namespace parvis::reflection_search {

struct Ellipsoid {
  glm::vec3 radii{1.0f};
  bool is_concave = false;  ///< it reflects inside

  std::pair<glm::vec3, glm::vec3> surface(glm::vec3 direction) const {
    const glm::vec3 position = direction / glm::length(direction / radii);
    const glm::vec3 outward = glm::normalize(position / (radii * radii));
    return {position, is_concave ? -outward : outward};
  }
};

}  // namespace parvis::reflection_search
