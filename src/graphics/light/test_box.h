// For tests: a box on a plain.
#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "scene/data/scene.h"

namespace parvis::light {

/// A plain of 60 x 60 m at height 0 and a box between two corners, as one static object.
inline scene::Scene box_on_a_plain(glm::vec3 low, glm::vec3 high) {
  Mesh mesh;
  const auto quad = [&](glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
    const std::uint32_t first = std::uint32_t(mesh.positions.size());
    const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
    for (const glm::vec3 p : {a, b, c, d}) {
      mesh.positions.push_back(p);
      mesh.normals.push_back(normal);
      mesh.uvs.emplace_back(0.0f);
    }
    for (const std::uint32_t k : {0u, 1u, 2u, 0u, 2u, 3u}) mesh.indices.push_back(first + k);
  };
  quad({-30, -30, 0}, {30, -30, 0}, {30, 30, 0}, {-30, 30, 0});
  quad({low.x, low.y, high.z}, {high.x, low.y, high.z}, high, {low.x, high.y, high.z});
  quad({low.x, low.y, low.z}, {high.x, low.y, low.z}, {high.x, low.y, high.z},
       {low.x, low.y, high.z});                                                          // south
  quad({high.x, high.y, low.z}, {low.x, high.y, low.z}, {low.x, high.y, high.z}, high);  // north
  quad({high.x, low.y, low.z}, {high.x, high.y, low.z}, high, {high.x, low.y, high.z});  // east
  quad({low.x, high.y, low.z}, {low.x, low.y, low.z}, {low.x, low.y, high.z},
       {low.x, high.y, high.z});  // west
  auto model = std::make_shared<scene::Model>();
  model->materials.emplace_back();
  model->nodes.emplace_back();
  scene::Part part;
  part.mesh = std::move(mesh), part.material = 0, part.node = 0;
  model->parts.push_back(std::move(part));
  scene::Scene scene;
  scene::Object object;
  object.name = "box", object.model = model;
  scene.objects.push_back(object);
  return scene;
}

}  // namespace parvis::light
