// Models made of models: wheels under a body, a model turned about before others use it.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "scene/data/model.h"

namespace parvis::scene {

/// Where a model hangs on a node of another.
struct Mount {
  std::string name;          ///< of the node it hangs on
  glm::vec3 position{0.0f};  ///< of that node
  glm::quat rotation{1.0f, 0.0f, 0.0f,
                     0.0f};  ///< of what hangs on it: the node itself keeps the model's axes
  float scale = 1.0f;
};

/// Hangs all of `part` (nodes, parts, materials, textures, animations) on a new node of `model` that hangs on
/// no other: the mount is in the model's frame, not in that of node 0, which turns a file's axes.
void mount(Model& model, const Model& part, const Mount& mount);

/// The model with everything turned, scaled and moved, in this order, by a node above the others.
Model placed(const Model& model, glm::vec3 position, const glm::quat& rotation, float scale);

}  // namespace parvis::scene
