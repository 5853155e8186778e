// What the room's tests search over.
#pragma once

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "base/random.h"
#include "reflections/reflector_maps/reflector_map.h"
#include "scene/data/test_scene.h"

namespace parvis::reflector_maps {

inline Mesh ellipsoid_mesh(glm::vec3 radii, int rings = 96) {
  Mesh mesh;
  append(mesh, scene::sphere(glm::vec3(0.0f), 1.0f, rings), glm::scale(glm::mat4(1.0f), radii));
  return mesh;
}

/// Its maps are 128 texels wide, or as their patches ask for.
inline Reflector reflector(const Mesh& mesh) {
  Result<Reflector> made = make_reflector(mesh, "kettle", 128);
  EXPECT_TRUE(made) << to_string(made.errors());
  return *std::move(made);
}

inline glm::vec3 chance_direction(Random& random) {
  glm::vec3 d;
  do d = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  while (glm::length(d) > 1.0f || glm::length(d) < 0.01f);
  return glm::normalize(d);
}

}  // namespace parvis::reflector_maps
