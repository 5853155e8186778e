// Walls for this room's tests.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "base/mesh.h"
#include "scene/data/model.h"

namespace parvis::dressing {

/// Two triangles, without normals and texture coordinates.
inline void add_quad(Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
  const std::uint32_t first = std::uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {a, b, c, d});
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

/// A building to which walls are added: one part, one material.
inline scene::Model no_walls() {
  scene::Model model;
  model.materials.emplace_back();
  model.parts.emplace_back();
  model.parts.front().object = "building";
  return model;
}

}  // namespace parvis::dressing
