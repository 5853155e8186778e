#include "formats/meshes/simplification.h"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(Simplification, LeavesMeshesWithoutExtentAsTheyAre) {
  EXPECT_EQ(simplified(Mesh{}, 0.1f).triangle_count(), 0u);
  Mesh point;
  point.positions.assign(3, glm::vec3(1.0f)), point.indices = {0, 1, 2};
  EXPECT_EQ(simplified(point, 0.1f).indices, point.indices);
}

}  // namespace
}  // namespace parvis::scene
