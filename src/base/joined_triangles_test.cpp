#include "base/joined_triangles.h"

#include <gtest/gtest.h>

namespace parvis {
namespace {

/// Four triangles about a corner, none of whose vertices is shared.
Mesh tetrahedron(glm::vec3 at) {
  const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1);
  Mesh mesh;
  for (const glm::vec3 corner : {a, c, b, a, b, d, b, c, d, c, a, d}) mesh.positions.push_back(at + corner);
  mesh.normals.resize(12);
  mesh.uvs.resize(12);
  for (std::uint32_t i = 0; i < 12; ++i) mesh.indices.push_back(i);
  return mesh;
}

TEST(JoinedTriangles, TouchWhereTheirCornersAreAtOnePlace) {
  const JoinedTriangles joined = joined_triangles(tetrahedron({5, 0, 0}));
  EXPECT_EQ(joined.triangles.size(), 4u);
  EXPECT_EQ(joined.open_edges, 0u);
  for (const auto& neighbours : joined.neighbours)
    for (const std::uint32_t other : neighbours) EXPECT_NE(other, no_triangle);
}

/// Wherever the mesh lies.
TEST(JoinedTriangles, TouchWhereCornersAreOneButForRounding) {
  for (int step = 0; step < 100; ++step) {
    Mesh mesh = tetrahedron(glm::vec3(0.0123f * float(step), 0.3f, 0.7f));
    for (std::size_t i = 0; i < 3; ++i) mesh.positions[i] += 5e-7f;
    EXPECT_EQ(joined_triangles(mesh).open_edges, 0u) << step;
  }
}

/// The boxes lie as far out as numbers have steps of a millionth of its size, and where cells counted from
/// the origin would have no numbers.
TEST(JoinedTriangles, TouchFarFromTheOrigin) {
  for (const float far : {3.0f, 3e5f, 3e15f}) {
    const float size = 0.005f * far;
    Mesh mesh = tetrahedron({0, 0, 0});
    for (glm::vec3& position : mesh.positions) position = far + size * position;
    for (std::size_t i = 0; i < 3; ++i) mesh.positions[i] = glm::vec3(1.0f + 1.2e-7f) * mesh.positions[i];
    EXPECT_EQ(joined_triangles(mesh).open_edges, 0u) << far;
    EXPECT_EQ(joined_triangles(mesh).triangles.size(), 4u) << far;
  }
  Mesh flat = tetrahedron({0, 0, 0});
  for (glm::vec3& position : flat.positions) position.x = 1e18f;
  EXPECT_TRUE(joined_triangles(flat).triangles.empty()) << "less than rounding is no extent";
}

TEST(JoinedTriangles, PiecesAreClosedOrOpenEachForItself) {
  Mesh mesh = tetrahedron({0, 0, 0});
  append(mesh, tetrahedron({3, 0, 0}));
  mesh.indices.resize(mesh.indices.size() - 3);  // the second is open
  append(mesh, tetrahedron({1, 0, 0}));          // touches the first in a corner alone
  const std::vector<MeshPiece> found = pieces(joined_triangles(mesh));
  ASSERT_EQ(found.size(), 3u);
  EXPECT_TRUE(found[0].is_closed);
  EXPECT_FALSE(found[1].is_closed);
  EXPECT_TRUE(found[2].is_closed);
  EXPECT_EQ(found[1].triangles.size(), 3u);
}

TEST(JoinedTriangles, WhatHasNoAreaIsLeftOutAndThreeAtAnEdgeAreOpen) {
  Mesh mesh = tetrahedron({0, 0, 0});
  for (const std::uint32_t corner : {0u, 0u, 1u}) mesh.indices.push_back(corner);
  EXPECT_EQ(joined_triangles(mesh).triangles.back()[0], mesh.indices[9]);
  EXPECT_EQ(joined_triangles(mesh).open_edges, 0u);
  mesh.positions.emplace_back(2, 2, 2);
  mesh.normals.emplace_back(0);
  mesh.uvs.emplace_back(0);
  for (const std::uint32_t corner : {0u, 1u, 12u}) mesh.indices.push_back(corner);
  EXPECT_EQ(joined_triangles(mesh).open_edges, 3u) << "the fin's two rims, and where it stands on the body";
  EXPECT_TRUE(joined_triangles(Mesh()).triangles.empty());
  for (const float huge : {0.0f, 1e30f, 1e38f}) {
    Mesh other = mesh;
    for (glm::vec3& position : other.positions) position = huge * position + 1.0f;
    EXPECT_TRUE(joined_triangles(other).triangles.empty()) << huge;
  }
}

void add_triangle(Mesh& mesh, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  for (const glm::vec3 corner : {a, b, c}) {
    mesh.indices.push_back(std::uint32_t(mesh.positions.size()));
    mesh.positions.push_back(corner);
  }
  mesh.normals.resize(mesh.positions.size());
  mesh.uvs.resize(mesh.positions.size());
}

TEST(MeshShells, AreClosedOverSlivers) {
  const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1), middle(0.5f, 0, 0);
  Mesh mesh;  // the tetrahedron, one side of which is cut in two where the other is not
  add_triangle(mesh, a, c, b);
  add_triangle(mesh, a, middle, d);
  add_triangle(mesh, middle, b, d);
  add_triangle(mesh, b, c, d);
  add_triangle(mesh, c, a, d);
  EXPECT_FALSE(shells(mesh).at(0).is_closed) << "the cut side has a corner that the other has not";
  add_triangle(mesh, a, b, middle);
  const std::vector<MeshShell> found = shells(mesh);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_closed);
  EXPECT_EQ(found[0].triangles.size(), 6u);
  EXPECT_NEAR(found[0].volume, 1.0 / 6.0, 1e-6);
}

TEST(MeshShells, AreClosedWhereTwoBodiesStandFaceToFace) {
  Mesh mesh = tetrahedron({0, 0, 0});
  const glm::vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, -1);
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, d, b);
  add_triangle(mesh, b, d, c);
  add_triangle(mesh, c, d, a);
  const std::vector<MeshShell> found = shells(mesh);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_TRUE(found[0].is_closed);
  EXPECT_NEAR(found[0].volume, 2.0 / 6.0, 1e-6);
}

TEST(MeshShells, CountCopiesOnceAndSheetsOfTwoSidesAsOpen) {
  Mesh mesh = tetrahedron({5, 0, 0});
  for (std::size_t i = 0; i < 3; ++i) mesh.indices.push_back(mesh.indices[(i + 1) % 3]);
  ASSERT_EQ(shells(mesh).size(), 1u);
  EXPECT_TRUE(shells(mesh)[0].is_closed);
  EXPECT_EQ(shells(mesh)[0].triangles.size(), 5u);
  EXPECT_NEAR(shells(mesh)[0].volume, 1.0 / 6.0, 1e-6);
  Mesh sheet;
  add_triangle(sheet, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  add_triangle(sheet, {0, 0, 0}, {0, 1, 0}, {1, 0, 0});
  ASSERT_EQ(shells(sheet).size(), 1u);
  EXPECT_FALSE(shells(sheet)[0].is_closed);
  EXPECT_TRUE(shells(Mesh()).empty());
}

}  // namespace
}  // namespace parvis
