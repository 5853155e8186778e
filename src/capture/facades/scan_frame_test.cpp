#include "capture/facades/scan_frame.h"

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "base/random.h"
#include "capture/facades/test_model.h"

namespace parvis::facades {
namespace {

using photographs::PhotographSet;

/// A wall 6 m ahead with a box before it, 1 m deep.
std::vector<NamedMesh> house() {
  return {wall("wall", 6, -4, 4, -2, 3), box("porch", {-1, 5, -2}, {1, 6, 0})};
}

/// Photographs of it, the points on it that they have in common, and a frame in which they were given: half
/// as large, and upside down.
PhotographSet photographs_of_house() {
  PhotographSet set;
  for (int i = 0; i < 5; ++i) {
    Camera camera;
    camera.world_from_camera = look_at({-2.0f + float(i), 0.0f, 0.2f * float(i)}, {0.0f, 6.0f, 0.5f});
    camera.vertical_fov = 1.0f;
    set.photographs.push_back(photographs::photograph_of(camera, fmt::format("{}.jpg", i), 1200, 900));
  }
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    const double a = double(random.uniform()), b = double(random.uniform());
    photographs::SparsePoint point;
    point.position_in_world = i % 3 ? glm::dvec3(-4.0 + 8.0 * a, 6.0, 0.1 + 2.8 * b)
                                    : glm::dvec3(-0.9 + 1.8 * a, 5.0, -1.9 + 1.8 * b);
    for (int k = 0; k < 5; ++k) point.observations.push_back({k, {0.0, 0.0}});
    set.points.push_back(point);
  }
  set.world_from_given =
      glm::rotate(glm::scale(glm::dmat4(1.0), glm::dvec3(2.0)), glm::radians(180.0), glm::dvec3(1, 0, 0));
  return set;
}

std::vector<NamedMesh> seen_from(const glm::dmat4& frame_from_world, std::vector<NamedMesh> meshes) {
  for (NamedMesh& named : meshes)
    for (glm::vec3& p : named.mesh.positions) p = glm::vec3(frame_from_world * glm::dvec4(p, 1.0));
  return meshes;
}

void expect_house(const Result<PlacedScan>& placed, const char* what) {
  ASSERT_TRUE(placed) << what << ": " << to_string(placed.errors());
  const std::vector<NamedMesh> truth = house();
  ASSERT_EQ(placed->meshes.size(), truth.size());
  for (std::size_t m = 0; m < truth.size(); ++m)
    for (std::size_t v = 0; v < truth[m].mesh.positions.size(); ++v)
      EXPECT_LT(glm::distance(placed->meshes[m].mesh.positions[v], truth[m].mesh.positions[v]), 1e-4f)
          << what << " " << truth[m].name;
}

TEST(ScanFrame, AScanOfThePlaceStaysAsItIs) {
  const Result<PlacedScan> placed = placed_scan(house(), photographs_of_house());
  expect_house(placed, "as it is");
  ASSERT_TRUE(placed);
  EXPECT_FALSE(placed->is_moved);
}

TEST(ScanFrame, AScanOfTheGivenCamerasFollowsThem) {
  const PhotographSet set = photographs_of_house();
  const glm::dmat4 given_from_world = glm::inverse(set.world_from_given),
                   reader = glm::rotate(glm::dmat4(1.0), glm::radians(90.0), glm::dvec3(1, 0, 0));
  for (const auto& [frame, what] :
       {std::pair(given_from_world, "given"), std::pair(reader, "y up"),
        std::pair(reader * given_from_world, "given, in a format whose y is up")}) {
    const Result<PlacedScan> placed = placed_scan(seen_from(frame, house()), set);
    expect_house(placed, what);
    if (placed) {
      EXPECT_TRUE(placed->is_moved) << what;
    }
  }
}

TEST(ScanFrame, AScanOfAnotherPlaceIsAnError) {
  const glm::dmat4 nearer = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -3.0, 0.0)),
                   away = glm::translate(glm::dmat4(1.0), glm::dvec3(50.0, 0.0, 0.0));
  for (const glm::dmat4& frame : {nearer, away}) {
    const Result<PlacedScan> placed = placed_scan(seen_from(frame, house()), photographs_of_house());
    ASSERT_FALSE(placed);
    EXPECT_NE(to_string(placed.errors()).find("--cameras"), std::string::npos) << to_string(placed.errors());
  }
}

TEST(ScanFrame, WithoutPointsItStaysAsItIs) {
  PhotographSet set = photographs_of_house();
  set.points.clear();
  const Result<PlacedScan> placed = placed_scan(seen_from(set.world_from_given, house()), set);
  ASSERT_TRUE(placed);
  EXPECT_FALSE(placed->is_moved);
}

}  // namespace
}  // namespace parvis::facades
