#include "places/dressing/roofs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

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

/// Adds a square roof of `side_m` whose ridge, if it rises, runs from west to east.
void add_roof(scene::Model& model, glm::vec3 corner, float side_m, float rise_m) {
  scene::Part part;
  part.object = "RoofSurface";
  const float half = 0.5f * side_m;
  for (const glm::vec3 p : {glm::vec3(0, 0, 0),
                            {side_m, 0, 0},
                            {side_m, half, rise_m},
                            {0, half, rise_m},
                            {side_m, side_m, 0},
                            {0, side_m, 0}})
    part.mesh.positions.push_back(corner + p);
  part.mesh.indices = {0, 1, 2, 0, 2, 3, 3, 2, 4, 3, 4, 5};
  fill_normals(part.mesh);
  part.mesh.uvs.resize(6);
  model.parts.push_back(std::move(part));
}

/// The box around the parts of a name.
Bounds bounds_of(const scene::Model& model, const std::string& object) {
  Bounds bounds;
  for (const scene::Part& part : model.parts)
    if (part.object == object) bounds.add(part.mesh.bounds());
  return bounds;
}

TEST(Roofs, LargeFlatOnesHaveAParapetAtTheirFreeEdges) {
  scene::Model model;
  model.materials.emplace_back();
  add_roof(model, {0, 0, 5}, 10, 0);
  add_roof(model, {10, 0, 5.1f}, 10, 0);  // a neighbour of the same height
  add_roof(model, {0, 10, 9}, 10, 0);     // a higher one
  add_roof(model, {40, 40, 3}, 4, 0);     // a shed
  add_roofs(model, "RoofSurface");
  const Bounds edges = bounds_of(model, "RoofEdge");
  ASSERT_FALSE(edges.empty());
  EXPECT_LT(edges.max.x, 21.0f) << "the shed has none";
  EXPECT_NEAR(edges.min.x, -0.05f, 1e-4f);
  EXPECT_GT(edges.max.z, 9.1f);
  for (const scene::Part& part : model.parts) {
    if (part.object != "RoofEdge") continue;
    EXPECT_TRUE(check(part.mesh, "parapet").ok());
    for (const glm::vec3 p : part.mesh.positions) {
      const bool is_between = std::abs(p.x - 10.0f) < 0.1f && p.y > 0.5f && p.y < 9.5f;
      EXPECT_FALSE(is_between) << "no parapet between equal neighbours";
    }
  }
  scene::Model bare;
  bare.materials.emplace_back();
  add_roof(bare, {0, 0, 5}, 10, 0);
  add_roofs(bare, "RoofSurface", false);
  EXPECT_TRUE(bounds_of(bare, "RoofEdge").empty());
}

TEST(Roofs, ChimneysStandOnRidges) {
  scene::Model model;
  model.materials.emplace_back();
  for (int i = 0; i < 12; ++i) add_roof(model, {30.0f * float(i), 0, 5}, 20, 6);
  add_roofs(model, "RoofSurface");
  const Bounds chimneys = bounds_of(model, "Chimney");
  ASSERT_FALSE(chimneys.empty());
  EXPECT_NEAR(chimneys.centre().y, 10.0f, 0.1f);
  EXPECT_GT(chimneys.max.z, 11.5f);
  EXPECT_GT(chimneys.min.z, 9.0f);
  EXPECT_TRUE(bounds_of(model, "RoofEdge").empty());
}

TEST(Roofs, WithoutRoofsNothingChanges) {
  scene::Model model = roof(1.0f);
  EXPECT_EQ(add_roofs(model, "no such name"), 0u);
  EXPECT_TRUE(model.textures.empty());
}

/// The sides of a pyramid, each a polygon of its own.
scene::Model pyramid(int sides, float radius_m, float rise_m) {
  scene::Model model;
  model.materials.emplace_back();
  scene::Part part;
  part.object = "RoofSurface";
  const auto corner = [&](int i) {
    const float angle = glm::two_pi<float>() * float(i % sides) / float(sides);
    return glm::vec3(radius_m * std::cos(angle), radius_m * std::sin(angle), 8.0f);
  };
  for (int i = 0; i < sides; ++i) {
    const std::uint32_t first = std::uint32_t(part.mesh.positions.size());
    part.mesh.positions.insert(part.mesh.positions.end(),
                               {corner(i), corner(i + 1), glm::vec3(0.0f, 0.0f, 8.0f + rise_m)});
    part.mesh.indices.insert(part.mesh.indices.end(), {first, first + 1, first + 2});
  }
  fill_normals(part.mesh);
  part.mesh.uvs.resize(part.mesh.positions.size());
  model.parts.push_back(std::move(part));
  return model;
}

/// Calls use(a, b) for the edges of all triangles, by the numbers of their corners.
template <class Use>
void each_edge(const Mesh& mesh, const Use& use) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) use(mesh.indices[i + k], mesh.indices[i + (k + 1) % 3]);
}

TEST(Roofs, TilesGoRoundCones) {
  constexpr float tiles_per_sheet = 24.0f, courses_per_sheet = 16.0f;
  scene::Model cone = pyramid(24, 5.0f, 4.0f);
  EXPECT_EQ(add_roofs(cone, "Roof*", false), 24u);
  ASSERT_EQ(cone.parts.size(), 1u);
  const Mesh& mesh = cone.parts[0].mesh;
  EXPECT_TRUE(check(mesh, "cone").ok());
  double area_m2 = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto at = [&](std::size_t k) { return mesh.positions[mesh.indices[i + k]]; };
    area_m2 += 0.5 * double(glm::cross(at(1) - at(0), at(2) - at(0)).z);
  }
  EXPECT_NEAR(area_m2, 12.0 * 25.0 * std::sin(glm::two_pi<double>() / 24.0), 1e-3) << "in plan: all, once";

  // Edges that lie level: their tiles are about as wide everywhere, and so are courses high.
  int level = 0;
  each_edge(mesh, [&](std::uint32_t a, std::uint32_t b) {
    if (std::abs(mesh.positions[a].z - mesh.positions[b].z) > 1e-3f) return;
    const float tiles = tiles_per_sheet * std::abs(mesh.uvs[a].x - mesh.uvs[b].x);
    const float tile_m = glm::distance(mesh.positions[a], mesh.positions[b]) / tiles;
    EXPECT_GT(tile_m, 0.1f);
    EXPECT_LT(tile_m, 0.36f);
    EXPECT_NEAR(mesh.uvs[a].y, mesh.uvs[b].y, 1e-5f);
    ++level;
  });
  EXPECT_GT(level, 24) << "more than the foot";
  const float slope_m = std::hypot(5.0f, 4.0f);
  int at_foot = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (mesh.positions[i].z < 8.001f) {
      EXPECT_NEAR(mesh.uvs[i].y * courses_per_sheet, slope_m / 0.32f, 1e-2f);
      for (std::size_t k = 0; k < i; ++k) {
        if (glm::distance(mesh.positions[i], mesh.positions[k]) > 1e-3f) continue;
        const float apart = tiles_per_sheet * (mesh.uvs[i].x - mesh.uvs[k].x);
        EXPECT_NEAR(apart, std::round(apart), 1e-3f) << "no tile is cut where two sides meet";
        ++at_foot;
      }
    }
  EXPECT_GT(at_foot, 23);
}

TEST(Roofs, ConesAreShadedAsRoundAndPyramidsHaveEdges) {
  scene::Model cone = pyramid(24, 5.0f, 4.0f), octagon = pyramid(8, 5.0f, 1.0f);
  for (scene::Model* model : {&cone, &octagon}) {
    add_roofs(*model, "Roof*", false);
    ASSERT_EQ(model->parts.size(), 1u);
    const Mesh& mesh = model->parts[0].mesh;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      if (mesh.positions[i].z > 8.1f) continue;
      const glm::vec2 outward = glm::normalize(glm::vec2(mesh.positions[i])),
                      facing = glm::normalize(glm::vec2(mesh.normals[i]));
      if (model == &cone)
        EXPECT_GT(glm::dot(outward, facing), 0.9999f);
      else
        EXPECT_NEAR(glm::dot(outward, facing), std::cos(glm::pi<float>() / 8.0f), 1e-3f);
    }
  }
}

}  // namespace
}  // namespace parvis::dressing
