// Small models and views with known visibility, for tests.
#pragma once

#include <gtest/gtest.h>

#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <string>
#include <vector>

#include "capture/facades/layer_model.h"
#include "capture/facades/view.h"

namespace parvis::facades {

/// A view at the origin that looks along world +y with z up; 90 degrees wide.
inline View test_view(int width = 128, int height = 128, glm::dvec3 centre = {0, 0, 0}) {
  View view;
  view.camera_from_world = glm::transpose(glm::dmat3(1, 0, 0, 0, 0, -1, 0, 1, 0));  // rows: x, -z, y
  view.centre = centre;
  view.width = width, view.height = height;
  view.fx = view.fy = 0.5 * width;
  view.cx = 0.5 * width, view.cy = 0.5 * height;
  return view;
}

/// A parallelogram as two triangles.
inline NamedMesh quad(const std::string& name, glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
  NamedMesh named{name, {}};
  named.mesh.positions = {corner, corner + u, corner + u + v, corner + v};
  named.mesh.indices = {0, 1, 2, 0, 2, 3};
  fill_normals(named.mesh);
  named.mesh.uvs.assign(4, glm::vec2(0.0f));
  return named;
}

/// Facing the test view: at depth y, from (x0, z0) to (x1, z1).
inline NamedMesh wall(const std::string& name, float y, float x0, float x1, float z0, float z1) {
  return quad(name, {x0, y, z0}, {x1 - x0, 0, 0}, {0, 0, z1 - z0});
}

/// A closed box, triangles outward.
inline NamedMesh box(const std::string& name, glm::vec3 low, glm::vec3 high) {
  NamedMesh named{name, {}};
  for (int i = 0; i < 8; ++i)
    named.mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
  named.mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                        2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  named.mesh.normals.assign(8, glm::vec3(0, 0, 1));
  named.mesh.uvs.assign(8, glm::vec2(0.0f));
  return named;
}

/// The layer model of valid meshes.
inline LayerModel model_of(const std::vector<NamedMesh>& meshes) {
  Result<LayerModelResult> made = layer_model(meshes);
  EXPECT_TRUE(made) << to_string(made ? Errors{} : made.errors());
  return made ? made->model : LayerModel{};
}

}  // namespace parvis::facades
