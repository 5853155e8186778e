#include "formats/meshes/simplification.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace parvis::scene {
namespace {

/// A square metre of `side` times `side` cells whose heights are a function of the place.
template <class HeightAt>
Mesh sheet(std::uint32_t side, const HeightAt& height_at) {
  Mesh mesh;
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x) {
      const glm::vec2 p = glm::vec2(x, y) / float(side);
      mesh.positions.emplace_back(p, height_at(p)), mesh.uvs.push_back(p);
    }
  for (std::uint32_t y = 0; y < side; ++y)
    for (std::uint32_t x = 0; x < side; ++x) {
      const std::uint32_t a = y * (side + 1) + x, b = a + side + 1;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  fill_normals(mesh);
  return mesh;
}

TEST(Simplification, TakesFewTrianglesForAFlatSheetAndKeepsItsRim) {
  const Mesh flat = sheet(20, [](glm::vec2) { return 0.5f; });
  const Mesh fewer = simplified(flat, 0.001f);
  EXPECT_TRUE(check(fewer, "sheet"));
  EXPECT_LT(fewer.triangle_count(), 120u) << "of 800; 80 edges of the rim stay";
  EXPECT_GE(fewer.positions.size(), 80u);
  float area = 0.0f;
  for (std::size_t i = 0; i < fewer.indices.size(); i += 3) {
    const glm::vec3 a = fewer.positions[fewer.indices[i]];
    area += 0.5f * glm::length(glm::cross(fewer.positions[fewer.indices[i + 1]] - a,
                                          fewer.positions[fewer.indices[i + 2]] - a));
  }
  EXPECT_NEAR(area, 1.0f, 1e-4f);
}

TEST(Simplification, KeepsTheShapeWithinItsErrorAndTheVerticesAsTheyWere) {
  const auto wave = [](glm::vec2 p) { return 0.1f * std::sin(9.0f * p.x) * std::cos(7.0f * p.y); };
  const Mesh fine = sheet(60, wave);
  const Mesh fewer = simplified(fine, 0.002f), coarse = simplified(fine, 0.02f);
  EXPECT_LT(fewer.triangle_count(), fine.triangle_count() / 2);
  EXPECT_LT(coarse.triangle_count(), fewer.triangle_count());
  for (std::size_t i = 0; i < fewer.positions.size(); ++i)
    EXPECT_NEAR(fewer.positions[i].z, wave(fewer.uvs[i]), 1e-6f) << "vertices keep their own uvs";
  float largest = 0.0f;
  for (std::size_t i = 0; i < fewer.indices.size(); i += 3) {
    const glm::vec3 middle = (fewer.positions[fewer.indices[i]] + fewer.positions[fewer.indices[i + 1]] +
                              fewer.positions[fewer.indices[i + 2]]) /
                             3.0f;
    largest = std::max(largest, std::abs(middle.z - wave(glm::vec2(middle))));
  }
  EXPECT_LT(largest, 0.008f);
}

/// A round cap in two meshes, left and right of x = 0.5, that share the points between them.
std::array<Mesh, 2> divided_cap() {
  const Mesh whole = sheet(30, [](glm::vec2 p) { return -0.2f * glm::dot(p - 0.5f, p - 0.5f); });
  std::array<Mesh, 2> halves{whole, whole};
  for (Mesh& half : halves) half.indices.clear();
  for (std::size_t i = 0; i < whole.indices.size(); i += 3) {
    float x = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) x += whole.positions[whole.indices[i + k]].x / 3.0f;
    std::vector<std::uint32_t>& indices = halves[x < 0.5f ? 0 : 1].indices;
    indices.insert(indices.end(), whole.indices.begin() + std::ptrdiff_t(i),
                   whole.indices.begin() + std::ptrdiff_t(i) + 3);
  }
  return halves;
}

/// The points of a mesh on the line between the halves.
std::set<std::array<float, 3>> points_between(const Mesh& mesh) {
  std::set<std::array<float, 3>> points;
  for (const std::uint32_t i : mesh.indices)
    if (const glm::vec3 p = mesh.positions[i]; p.x == 0.5f) points.insert({p.x, p.y, p.z});
  return points;
}

TEST(Simplification, MeshesThatTouchStillDoWithFewerPointsBetweenThem) {
  std::array<Mesh, 2> together = divided_cap(), alone = divided_cap();
  const std::size_t points_before = points_between(together[0]).size();
  simplify_together(std::array{&together[0], &together[1]}, 0.002f, 45.0f);
  for (Mesh& half : alone) half = simplified(half, 0.002f);
  for (const Mesh& half : together) EXPECT_TRUE(check(half, "half"));
  EXPECT_EQ(points_between(together[0]), points_between(together[1])) << "else there were a crack";
  EXPECT_LT(points_between(together[0]).size(), points_before / 2);
  EXPECT_EQ(points_between(alone[0]).size(), points_before) << "control: alone, a rim is left as it is";
  EXPECT_LT(together[0].triangle_count(), alone[0].triangle_count());
}

TEST(Simplification, VerticesOfFlatFacesBecomeOneUpToACrease) {
  for (const bool is_creased : {false, true}) {
    Mesh roof;  // two squares of vertices of their own, with a ridge between them
    const float z = is_creased ? 1.0f : 0.1f;
    roof.positions = {{0, 0, 0}, {1, 0, z}, {1, 1, z}, {0, 1, 0}, {1, 0, z}, {2, 0, 0}, {2, 1, 0}, {1, 1, z}};
    roof.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    fill_normals(roof);
    simplify_together(std::array{&roof}, 1e-4f, 45.0f);
    EXPECT_EQ(roof.positions.size(), is_creased ? 8u : 6u);
    for (std::size_t i = 0; i < roof.positions.size(); ++i)
      if (roof.positions[i].x == 1.0f && !is_creased) {
        EXPECT_NEAR(roof.normals[i].z, 1.0f, 1e-3f) << "the mean by triangles; of one square: 0.995";
      }
  }
}

TEST(Simplification, LeavesMeshesWithoutExtentAsTheyAre) {
  EXPECT_EQ(simplified(Mesh{}, 0.1f).triangle_count(), 0u);
  Mesh point;
  point.positions.assign(3, glm::vec3(1.0f)), point.indices = {0, 1, 2};
  EXPECT_EQ(simplified(point, 0.1f).indices, point.indices);
}

}  // namespace
}  // namespace parvis::scene
