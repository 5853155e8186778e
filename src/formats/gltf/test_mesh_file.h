// Models of one grey mesh as files, for the tests of rooms whose scripts name them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>

#include "formats/gltf/gltf_writer.h"
#include "scene/data/test_scene.h"

namespace parvis::scene {

/// Writes a .glb.
inline void write_grey(const std::filesystem::path& file, const Mesh& mesh, bool is_double_sided = false) {
  Material material = matt(glm::vec3(0.5f));
  material.is_double_sided = is_double_sided;
  EXPECT_TRUE(write_gltf(file, *model_of(mesh, material)));
}

}  // namespace parvis::scene
