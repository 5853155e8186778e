#include "capture/facades/surface_check.h"

#include <gtest/gtest.h>

#include "capture/facades/test_street.h"

namespace parvis::facades {
namespace {

/// Colours that do not repeat themselves, of a point.
glm::vec3 painted(glm::dvec3 p) {
  const double value = 0.3 + 0.1 * std::sin(2.1 * p.x + 0.3 * p.z) + 0.1 * std::sin(3.7 * p.z - p.x + p.y);
  return {value, 0.3 + 0.15 * std::sin(1.3 * p.x), 0.04 * p.y};
}

/// Photographs of the street from places beside each other.
std::vector<PreparedPhoto> photos_of_street(const TestFolder& folder) {
  std::vector<photographs::Photograph> photographs;
  for (int i = 0; i < 6; ++i)
    photographs.push_back(photograph_of(street(), painted, folder, fmt::format("{}.png", i),
                                        test_view(96, 72, {0.7 * i - 1.75, 0.2 * (i % 3), 0.2 * (i % 2)}),
                                        1.0f));
  return small_photos(photographs);
}

std::vector<std::string> names_of(const std::vector<NamedMesh>& meshes) {
  std::vector<std::string> names;
  for (const NamedMesh& named : meshes) names.push_back(named.name);
  return names;
}

TEST(SurfaceCheck, WhatIsThereStays) {
  const TestFolder folder;
  std::vector<NamedMesh> meshes = street();
  const Errors notes = leave_out_what_makes_worse(meshes, street(), photos_of_street(folder));
  EXPECT_TRUE(notes.empty()) << to_string(notes);
  EXPECT_EQ(names_of(meshes), (std::vector<std::string>{"far", "near", "post"}));
}

TEST(SurfaceCheck, ASurfaceThatIsNotThereIsLeftOut) {
  const TestFolder folder;
  std::vector<NamedMesh> meshes = street();
  meshes.push_back(wall("roof_1", 2.5, -3.0f, -1.0f, -1.5, 1.5));
  const std::vector<NamedMesh> proposed = meshes;
  const Errors notes = leave_out_what_makes_worse(meshes, proposed, photos_of_street(folder));
  EXPECT_EQ(names_of(meshes), names_of(street()));
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].message.find("roof_1 is left out"), std::string::npos) << notes[0].message;
}

TEST(SurfaceCheck, AFalseReliefIsTakenOffASurface) {
  const TestFolder folder;
  std::vector<NamedMesh> meshes = street();
  meshes[0] = fine_street(8)[0];
  for (glm::vec3& position : meshes[0].mesh.positions)  // a bulge of 2 m in the far wall
    if (std::abs(position.x) < 7.0f && std::abs(position.z) < 5.0f) position.y -= 2.0f;
  const Errors notes = leave_out_what_makes_worse(meshes, street(), photos_of_street(folder));
  EXPECT_EQ(meshes[0].mesh.indices.size(), 6u);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].message.find("far stays flat"), std::string::npos) << notes[0].message;
}

TEST(SurfaceCheck, ThreePhotographsProveNothing) {
  const TestFolder folder;
  std::vector<NamedMesh> meshes = street();
  meshes.push_back(wall("roof_1", 2.5, -3.0f, -1.0f, -1.5, 1.5));
  std::vector<PreparedPhoto> photos = photos_of_street(folder);
  photos.resize(3);
  EXPECT_TRUE(leave_out_what_makes_worse(meshes, meshes, photos).empty());
  EXPECT_EQ(meshes.size(), 4u);
}

}  // namespace
}  // namespace parvis::facades
