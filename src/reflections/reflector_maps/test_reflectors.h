// Reflectors for the room's tests.
#pragma once

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "reflections/reflector_maps/reflector_map.h"
#include "scene/data/test_scene.h"

namespace parvis::reflector_maps {

/// An ellipsoid centred at the origin.
inline Mesh ellipsoid_mesh(glm::vec3 radii, int rings = 96) {
  Mesh mesh;
  append(mesh, scene::sphere(glm::vec3(0.0f), 1.0f, rings), glm::scale(glm::mat4(1.0f), radii));
  return mesh;
}

/// The reflector of a mesh that must be valid. Its maps are 128 texels wide, or as wide as their patches
/// require.
inline Reflector reflector(const Mesh& mesh) {
  Result<Reflector> made = make_reflector(mesh, "kettle", 128);
  EXPECT_TRUE(made) << to_string(made.errors());
  return *std::move(made);
}

}  // namespace parvis::reflector_maps
