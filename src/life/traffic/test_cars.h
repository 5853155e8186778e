// Cars for tests.
#pragma once

#include <memory>

#include "scene/data/model.h"

namespace parvis::traffic {

/// Adds a few triangles that span a box.
inline void add_box(scene::Model& model, int node, glm::vec3 low, glm::vec3 high) {
  scene::Part part;
  part.node = node;
  part.mesh.positions = {low, {high.x, low.y, low.z}, {low.x, high.y, high.z}, high};
  part.mesh.indices = {0, 1, 2, 1, 3, 2};
  model.parts.push_back(std::move(part));
}

/// A body with four wheels on nodes of their own, x forward.
inline std::shared_ptr<const scene::Model> test_car(float length, float width) {
  auto model = std::make_shared<scene::Model>();
  add_box(*model, 0, {-0.5f * length, -0.5f * width, 0.0f}, {0.5f * length, 0.5f * width, 1.5f});
  for (const float x : {-0.3f, 0.3f})
    for (const float y : {-0.4f, 0.4f}) {
      scene::ModelNode node;
      node.name = x > 0.0f ? "Wheel-front" : "wheel_back";
      node.parent = 0;
      node.translation = {x * length, y * width, 0.3f};
      model->nodes.push_back(node);
      add_box(*model, int(model->nodes.size()) - 1, glm::vec3(-0.3f), glm::vec3(0.3f));
    }
  return model;
}

}  // namespace parvis::traffic
