#include "formats/city_models/straight_skeleton.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "base/random.h"
#include "formats/city_models/gables.h"
#include "formats/city_models/test_rings.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;
using PlanRing = std::vector<dvec2>;

const PlanRing t_shape{{0, 0}, {20, 0}, {20, 6}, {13, 6}, {13, 14}, {7, 14}, {7, 6}, {0, 6}};
const PlanRing u_shape{{0, 0}, {20, 0}, {20, 15}, {14, 15}, {14, 6}, {6, 6}, {6, 15}, {0, 15}};
const PlanRing city_block{{0, 0}, {20, 0}, {20, 20}, {0, 20}}, court{{6, 6}, {6, 14}, {14, 14}, {14, 6}};

/// Distance from a point to the line of a face's edge in plan.
double distance_m(const StraightSkeleton& skeleton, const std::vector<int>& face, dvec3 point) {
  const dvec2 a(skeleton.points[std::size_t(face[0])]), b(skeleton.points[std::size_t(face[1])]);
  const dvec2 along = glm::normalize(b - a), offset = dvec2(point) - a;
  return along.x * offset.y - along.y * offset.x;
}

/// Every edge of a face is one of its neighbour's, too, but for the eaves; all points lie on the planes of
/// all their faces and above the eaves.
void expect_roof(const StraightSkeleton& skeleton, std::size_t edges, double tolerance_m) {
  ASSERT_EQ(skeleton.faces.size(), edges);
  std::map<std::pair<int, int>, int> borders;
  for (const std::vector<int>& face : skeleton.faces)
    for (std::size_t i = 0; i < face.size(); ++i) {
      ++borders[{face[i], face[(i + 1) % face.size()]}];
      const dvec3& point = skeleton.points[std::size_t(face[i])];
      EXPECT_NEAR(distance_m(skeleton, face, point), point.z, tolerance_m);
      if (i >= 2) {
        EXPECT_GT(point.z, 0.0) << "above the eaves";
      }
    }
  std::size_t eaves = 0;
  for (const auto& [border, count] : borders) {
    EXPECT_EQ(count, 1);
    const auto [a, b] = border;
    if (borders.contains({b, a})) continue;
    ++eaves;
    EXPECT_EQ(skeleton.points[std::size_t(a)].z + skeleton.points[std::size_t(b)].z, 0.0) << "a crack";
  }
  EXPECT_EQ(eaves, edges);
}

TEST(StraightSkeleton, RidgesOfWingsLieAtHalfTheirWidth) {
  for (const auto& [ring, highest_m] : {std::pair(rectangle, 4.0), std::pair(l_shape, 2.5),
                                        std::pair(t_shape, 3.0), std::pair(u_shape, 3.0)}) {
    const auto skeleton = straight_skeleton({ring});
    ASSERT_TRUE(skeleton);
    expect_roof(*skeleton, ring.size(), 1e-9);
    EXPECT_NEAR(skeleton->highest_m(), highest_m, 1e-9);
  }
}

TEST(StraightSkeleton, CourtyardsAreLeftOpen) {
  const auto skeleton = straight_skeleton({city_block, court});
  ASSERT_TRUE(skeleton);
  expect_roof(*skeleton, 8, 1e-9);
  EXPECT_NEAR(skeleton->highest_m(), 3.0, 1e-9);
}

TEST(StraightSkeleton, RingsThatCrossOrAreTooLargeHaveNone) {
  EXPECT_FALSE(straight_skeleton({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}}));
  EXPECT_FALSE(straight_skeleton({{{0, 0}, {10, 0}}}));
  EXPECT_FALSE(straight_skeleton({{{0, 0}, {0, 0}, {0, 0}}}));
  EXPECT_FALSE(straight_skeleton({{{0, 0}, {NAN, 0}, {3, 3}}}));
  EXPECT_FALSE(straight_skeleton({PlanRing(max_skeleton_corners + 1, dvec2(1.0))}));
}

TEST(StraightSkeleton, StandsOnAnyOutline) {
  Random random(7);
  for (int outline = 0; outline < 300; ++outline) {
    PlanRing star;
    const int corners = 3 + random.index(30);
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + double(random.uniform(0.0f, 0.8f))) / corners;
      const double radius_m = double(random.uniform(3.0f, 18.0f));
      star.push_back(radius_m * dvec2(std::cos(angle), std::sin(angle)));
    }
    const auto skeleton = straight_skeleton({star});
    ASSERT_TRUE(skeleton) << outline;
    expect_roof(*skeleton, star.size(), 0.1);
  }
}

TEST(StraightSkeleton, StandsOnHousesThatWereDrawnByHand) {
  Random random(9);
  for (int outline = 0; outline < 300; ++outline) {
    const double angle = double(random.uniform(0.0f, 6.0f)), slip_m = outline % 3 == 0 ? 0.0 : 0.02;
    PlanRing house;
    for (const dvec2& corner : outline % 2 == 0 ? t_shape : u_shape)
      house.push_back(dvec2(std::cos(angle) * corner.x - std::sin(angle) * corner.y,
                            std::sin(angle) * corner.x + std::cos(angle) * corner.y) +
                      slip_m * dvec2(random.uniform(-0.5f, 0.5f), random.uniform(-0.5f, 0.5f)));
    const auto skeleton = straight_skeleton({house});
    ASSERT_TRUE(skeleton) << outline;
    expect_roof(*skeleton, house.size(), 0.05);
    EXPECT_NEAR(skeleton->highest_m(), 3.0, 0.05);
  }
}

TEST(Gables, StandAtTheEndsOfWings) {
  for (const auto& [ring, gables] : {std::pair(rectangle, 2), std::pair(l_shape, 2), std::pair(t_shape, 3),
                                     std::pair(u_shape, 2), std::pair(city_block, 0)}) {
    auto skeleton = straight_skeleton({ring});
    ASSERT_TRUE(skeleton);
    const double highest_m = skeleton->highest_m();
    const std::vector<bool> is_gable = raise_gables(*skeleton);
    EXPECT_EQ(std::ranges::count(is_gable, true), gables);
    expect_roof(*skeleton, ring.size(), 100.0);
    EXPECT_NEAR(skeleton->highest_m(), highest_m, 1e-9);
    for (std::size_t i = 0; i < is_gable.size(); ++i)
      for (const int point : skeleton->faces[i]) {
        const dvec3& at = skeleton->points[std::size_t(point)];
        EXPECT_NEAR(distance_m(*skeleton, skeleton->faces[i], at), is_gable[i] ? 0.0 : at.z, 1e-9);
      }
  }
}

}  // namespace
}  // namespace parvis::scene
