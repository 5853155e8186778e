#include "reflections/reference_maps/placement.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "reflections/reference_maps/scene_maps.h"
#include "scene/data/test_scene.h"

namespace parvis::reference_maps {
namespace {

HeightPyramid pyramid_of(const scene::Scene& scene) { return HeightPyramid(heights_of(scene)); }

/// Ground of 200 m by 200 m, and blocks that leave streets between them.
scene::Scene town(const std::vector<Bounds>& blocks) {
  scene::Scene scene;
  Mesh mesh = scene::ground(100.0f);
  for (const Bounds& block : blocks) append(mesh, scene::box(block.min, block.max));
  scene::add(scene, scene::model_of(mesh, scene::matt(glm::vec3(0.5f))));
  return scene;
}

/// Two streets of 12 m, 160 m long, that cross in the middle; walls close their ends.
scene::Scene crossing() {
  std::vector<Bounds> blocks;
  for (const float x : {-1.0f, 1.0f})
    for (const float y : {-1.0f, 1.0f}) {
      Bounds block;
      block.add({6.0f * x, 6.0f * y, 0.0f});
      block.add({80.0f * x, 80.0f * y, 15.0f});
      blocks.push_back(block);
    }
  scene::Scene scene = town(blocks);
  scene.roads.lanes = {{{{-78, 0, 0}, {78, 0, 0}}, {}}, {{{0, -78, 0}, {0, 78, 0}}, {}}};
  return scene;
}

/// Two courts behind walls, a lane in each.
scene::Scene courts() {
  std::vector<Bounds> walls;
  for (const float x : {-50.0f, 50.0f})
    for (const float side : {-1.0f, 1.0f}) {
      walls.push_back({{x + side * 20.0f - 1, -20, 0}, {x + side * 20.0f + 1, 20, 12}});
      walls.push_back({{x - 20, side * 20.0f - 1, 0}, {x + 20, side * 20.0f + 1, 12}});
    }
  scene::Scene scene = town(walls);
  scene.roads.lanes = {{{{-62, 0, 0}, {-38, 0, 0}}, {}}, {{{38, 0, 0}, {62, 0, 0}}, {}}};
  return scene;
}

float share_shown(const scene::Scene& scene, const std::vector<glm::vec3>& places,
                  float sharpness = any_sharpness) {
  const HeightPyramid heights = pyramid_of(scene);
  return coverage(heights, places, mirrored_points(scene, heights, 4000, 99), sharpness).back();
}

TEST(Placement, WhereStreetsCrossOneMapShowsBoth) {
  const scene::Scene scene = crossing();
  const Placement placement = place_by_coverage(scene, pyramid_of(scene), {54, 0.95f});
  ASSERT_EQ(placement.places.size(), 1u);
  EXPECT_LT(glm::length(glm::vec2(placement.places[0])), 7.0f);
  EXPECT_GT(share_shown(scene, placement.places), 0.94f);
  EXPECT_LT(share_shown(scene, {{-70, 0, 1.2f}}), 0.75f) << "a map at one end misses the other street";
}

TEST(Placement, WhatOneMapCannotSeeGetsAnother) {
  const scene::Scene scene = courts();
  const Placement placement = place_by_coverage(scene, pyramid_of(scene), {54, 0.97f});
  ASSERT_EQ(placement.places.size(), 2u);
  EXPECT_LT(placement.places[0].x * placement.places[1].x, 0.0f) << "one in each court";
  EXPECT_NEAR(share_shown(scene, {placement.places[0]}), 0.5f, 0.1f);
}

TEST(Placement, SharperPicturesTakeMoreMapsAndFewerMapsShowLess) {
  const scene::Scene scene = crossing();
  const HeightPyramid heights = pyramid_of(scene);
  const Placement seen = place_by_coverage(scene, heights, {200, 0.95f, {any_sharpness}});
  const Placement sharp = place_by_coverage(scene, heights, {200, 0.95f, {4.0f}});
  EXPECT_GT(sharp.places.size(), seen.places.size() + 2);
  EXPECT_GE(sharp.share_shown, 0.95f);
  const Placement few = place_by_coverage(scene, heights, {4, 0.95f, {4.0f}});
  EXPECT_EQ(few.places.size(), 4u);
  EXPECT_LT(few.share_shown, sharp.share_shown);
  EXPECT_NEAR(share_shown(scene, sharp.places, 4.0f), sharp.share_shown, 0.02f) << "by other points";
}

TEST(Placement, AsManyMapsAsAreAllowedStandApart) {
  const scene::Scene scene = crossing();
  const Placement all = place_by_coverage(scene, pyramid_of(scene), {30, 2.0f, {any_sharpness, 4.0f}});
  ASSERT_GT(all.places.size(), 8u);
  EXPECT_LE(all.places.size(), 30u);
  for (std::size_t i = 0; i < all.places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) EXPECT_GE(glm::distance(all.places[i], all.places[j]), min_apart_m);
}

TEST(Placement, TheSameGoalGivesTheSamePlaces) {
  const scene::Scene scene = crossing();
  const PlacementGoal goal{20, 0.99f, {4.0f}};
  EXPECT_EQ(place_by_coverage(scene, pyramid_of(scene), goal).places,
            place_by_coverage(scene, pyramid_of(scene), goal).places);
}

TEST(Placement, WithoutRoadsMapsStandOnTheOpenGround) {
  scene::Scene scene = crossing();
  scene.roads.lanes.clear();
  const Placement placement = place_by_coverage(scene, pyramid_of(scene), {20, 0.9f});
  ASSERT_FALSE(placement.places.empty());
  for (const glm::vec3 place : placement.places) {
    EXPECT_LT(place.z, 2.0f);
    EXPECT_TRUE(std::min(std::abs(place.x), std::abs(place.y)) < 6.5f ||
                std::max(std::abs(place.x), std::abs(place.y)) > 79.5f);
  }
}

TEST(Placement, WhereNothingCanBeMirroredNoMapIsWanted) {
  const scene::Scene scene;
  const Placement placement = place_by_coverage(scene, pyramid_of(scene), {20, 0.99f});
  EXPECT_TRUE(placement.places.empty());
  EXPECT_TRUE(place_by_coverage(crossing(), pyramid_of(crossing()), {0, 0.99f}).places.empty());
}

TEST(Coverage, GrowsWithEachPlaceAndIsTheSameForTheSameSeed) {
  const scene::Scene scene = crossing();
  const HeightPyramid heights = pyramid_of(scene);
  const std::vector<MirroredPoint> points = mirrored_points(scene, heights, 2000, 5);
  ASSERT_EQ(points.size(), 2000u);
  const std::vector<MirroredPoint> again = mirrored_points(scene, heights, 2000, 5);
  EXPECT_EQ(points.back().position, again.back().position);
  const std::vector<glm::vec3> places = spread_places(scene, heights, 12);
  for (const float sharpness : {any_sharpness, 4.0f}) {
    const std::vector<float> shares = coverage(heights, places, points, sharpness);
    ASSERT_EQ(shares.size(), places.size());
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_GT(shares.front(), 0.0f);
  }
  EXPECT_GT(coverage(heights, places, points).back(), 0.95f);
}

TEST(Coverage, ATexelIsAsWideAsItsAngleDistanceAndSlantMakeIt) {
  const MirroredPoint wall{{10, 0, 5}, {-1, 0, 0}, 8.0f};
  EXPECT_FLOAT_EQ(footprint({2, 0, 5}, wall), 8.0f);
  EXPECT_FLOAT_EQ(footprint({4, 8, 5}, wall), 10.0f / std::sqrt(0.6f));
}

TEST(Coverage, AMapBehindAWallDoesNotShowWhatIsBeforeIt) {
  const scene::Scene scene = courts();
  const HeightPyramid heights = pyramid_of(scene);
  const MirroredPoint point{{-31.0f, 3.0f, 2.0f}, {-1, 0, 0}, 20.0f};
  EXPECT_TRUE(shows(heights, {-50, 0, 1.2f}, point, any_sharpness));
  EXPECT_FALSE(shows(heights, {50, 0, 1.2f}, point, any_sharpness));
  EXPECT_FALSE(shows(heights, {-50, 0, 1.2f}, point, 0.5f)) << "not that sharply";
}

}  // namespace
}  // namespace parvis::reference_maps
