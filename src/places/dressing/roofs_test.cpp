#include "places/dressing/roofs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/mesh.h"

namespace parvis::dressing {
namespace {

/// A square of 4 m a side that rises by `rise_m` to the north.
scene::Model roof(float rise_m) {
  scene::Model model;
  model.materials.emplace_back();
  scene::Part part;
  part.object = "RoofSurface";
  part.mesh.positions = {{0, 0, 5}, {4, 0, 5}, {4, 4, 5 + rise_m}, {0, 4, 5 + rise_m}};
  part.mesh.indices = {0, 1, 2, 0, 2, 3};
  fill_normals(part.mesh);
  part.mesh.uvs.resize(4);
  model.parts.push_back(std::move(part));
  return model;
}

const std::string& material_name(const scene::Model& model) {
  return model.materials[std::size_t(model.parts[0].material)].name;
}

TEST(Roofs, SlopesHaveLevelCoursesOfTiles) {
  scene::Model model = roof(3.0f);
  EXPECT_EQ(add_roofs(model, "Roof*"), 2u);
  ASSERT_EQ(model.parts.size(), 1u);
  EXPECT_EQ(material_name(model), "roof tiles");
  const Mesh& mesh = model.parts[0].mesh;
  EXPECT_TRUE(check(mesh, "roof").ok());
  const float per_m = (mesh.uvs[1].x - mesh.uvs[0].x) / 4.0f;
  EXPECT_NEAR(mesh.uvs[1].y, mesh.uvs[0].y, 1e-5f);                  // the eaves
  EXPECT_NEAR(mesh.uvs[2].y - mesh.uvs[1].y, -5.0f * per_m, 1e-4f);  // five metres of slope
}

TEST(Roofs, FlatOnesHaveGravel) {
  scene::Model model = roof(0.0f);
  EXPECT_EQ(add_roofs(model, "Roof*"), 2u);
  EXPECT_EQ(material_name(model), "flat roof");
}

TEST(Roofs, WithoutRoofsNothingChanges) {
  scene::Model model = roof(1.0f);
  EXPECT_EQ(add_roofs(model, "no such name"), 0u);
  EXPECT_TRUE(model.textures.empty());
}

}  // namespace
}  // namespace parvis::dressing
