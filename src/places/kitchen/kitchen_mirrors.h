// What mirrors in the kitchen: kettle, pans, spoons, a glass, a mixing bowl.
#pragma once

#include <vector>

#include "scene/data/model.h"

namespace parvis::kitchen {

/// A mirror and where it stands.
struct KitchenMirror {
  scene::Model model;
  glm::vec3 foot{0.0f};  ///< in the kitchen
  float heading_deg = 0.0f;
  float shade_m = 0.0f;  ///< radius of what it shades below it
};

/// Each a model of its own: its mirror-like parts take the scene's reflection method.
std::vector<KitchenMirror> kitchen_mirrors();

}  // namespace parvis::kitchen
