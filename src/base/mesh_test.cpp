#include "base/mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

namespace parvis {
namespace {

/// A triangle in the plane z = 0 that looks up.
Mesh triangle() {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, {0, 0, 1});
  mesh.uvs.assign(3, glm::vec2(0.0f));
  mesh.indices = {0, 1, 2};
  return mesh;
}

glm::vec3 facing(const Mesh& mesh) {
  const auto corner = [&](std::size_t i) { return mesh.positions[mesh.indices[i]]; };
  return glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
}

void expect_refused(const Mesh& mesh, const std::string& words) {
  const Status status = check(mesh, "roof.obj");
  ASSERT_FALSE(status) << words;
  const std::string message = to_string(status.errors());
  EXPECT_NE(message.find("roof.obj"), std::string::npos) << message;
  EXPECT_NE(message.find(words), std::string::npos) << message;
}

TEST(MeshCheck, GoodAndEmptyMeshesPass) {
  EXPECT_TRUE(check(triangle(), "roof.obj"));
  EXPECT_TRUE(check(Mesh{}, "roof.obj"));
}

TEST(MeshCheck, NumbersThatAreNotFiniteAreRefusedWithTheirVertex) {
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    Mesh mesh = triangle();
    mesh.positions[2].y = bad;
    expect_refused(mesh, "vertex 2");
    mesh = triangle();
    mesh.normals[1].z = bad;
    expect_refused(mesh, "vertex 1");
    mesh = triangle();
    mesh.uvs[0].x = bad;
    expect_refused(mesh, "vertex 0");
  }
}

TEST(MeshCheck, IndicesOutOfRangeAreRefusedWithTheirTriangle) {
  for (const std::uint32_t bad : {3u, 0xFFFFFFFFu}) {
    Mesh mesh = triangle();
    mesh.indices.insert(mesh.indices.end(), {0, 1, bad});
    expect_refused(mesh, "triangle 1");
  }
}

TEST(MeshCheck, ArraysThatDoNotMatchAreRefused) {
  Mesh mesh = triangle();
  mesh.indices.pop_back();
  expect_refused(mesh, "whole triangles");
  mesh = triangle();
  mesh.uvs.pop_back();
  expect_refused(mesh, "as many of each");
}

TEST(Mesh, AMirroredCopyStillFacesOutward) {
  Mesh mesh = triangle();
  append(mesh, triangle(), glm::scale(glm::mat4(1.0f), {-1, 1, 1}));
  ASSERT_EQ(mesh.triangle_count(), 2u);
  mesh.indices.erase(mesh.indices.begin(), mesh.indices.begin() + 3);
  EXPECT_NEAR(facing(mesh).z, 1.0f, 1e-6f);
  EXPECT_EQ(mesh.positions[4], glm::vec3(-1, 0, 0));
}

TEST(Mesh, NormalsTurnAsTheirSurfaceUnderUnevenScaling) {
  Mesh slope;
  slope.positions = {{0, 0, 0}, {1, 0, 1}, {0, 1, 0}};
  slope.indices = {0, 1, 2};
  fill_normals(slope);
  Mesh mesh;
  append(mesh, slope, glm::scale(glm::mat4(1.0f), {1, 1, 5}));
  EXPECT_LT(glm::distance(mesh.normals[0], facing(mesh)), 1e-5f);
}

TEST(Mesh, MissingNormalsAreThoseOfTheSurfaceEvenWhereItHasNoArea) {
  Mesh mesh = triangle();
  mesh.normals.clear();
  fill_normals(mesh);
  EXPECT_EQ(mesh.normals, triangle().normals);

  mesh.positions.assign(3, glm::vec3(1.0f));  // a point
  mesh.normals.clear();
  mesh.uvs.assign(3, glm::vec2(0.0f));
  fill_normals(mesh);
  EXPECT_TRUE(check(mesh, "point"));
  EXPECT_NEAR(glm::length(mesh.normals[0]), 1.0f, 1e-6f);
}

TEST(Bounds, OfNothingAreEmptyAndOfATurnedBoxHoldItsCorners) {
  EXPECT_TRUE(Mesh{}.bounds().empty());
  EXPECT_TRUE(transformed(glm::mat4(1.0f), Bounds{}).empty());
  const Bounds turned = transformed(glm::rotate(glm::mat4(1.0f), glm::radians(45.0f), {0, 0, 1}),
                                    Bounds{{-1, -1, -1}, {1, 1, 1}});
  EXPECT_NEAR(turned.max.x, std::sqrt(2.0f), 1e-5f);
  EXPECT_NEAR(turned.min.z, -1.0f, 1e-6f);
}

}  // namespace
}  // namespace parvis
