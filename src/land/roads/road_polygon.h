// Road surfaces as city models hold them.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace parvis::scene {

/// One polygon of a road's surface, in the model's frame.
struct RoadPolygon {
  std::vector<std::vector<glm::vec3>> rings;  ///< the outline, then the holes; not closed by a repeated point
  std::string function;  ///< as the file describes it ("rijbaan lokale weg", "voetpad"); may be empty
};

}  // namespace parvis::scene
