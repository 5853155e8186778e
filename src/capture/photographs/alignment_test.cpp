#include "capture/photographs/alignment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "capture/photographs/neighbours.h"
#include "capture/photographs/test_place.h"

namespace parvis::photographs {
namespace {

PhotographSet with_points(int count) {
  PhotographSet set = test_photographs(count, 320, 240);
  for (int k = 0; k < 200; ++k) {
    SparsePoint point;
    const double along = 0.06 * (k * 37 % 100), height = 0.04 * (k * 53 % 97);
    point.position_in_world = {k % 2 ? 0.0 : along, k % 2 ? along : 0.0, height};
    for (int i = 0; i < count; ++i) {
      const auto pixel = pixel_of_world(set.photographs[std::size_t(i)], point.position_in_world);
      if (pixel && is_inside(set.photographs[std::size_t(i)].lens, *pixel))
        point.observations.push_back({i, *pixel});
    }
    set.points.push_back(std::move(point));
  }
  return set;
}

TEST(Alignment, FindsUpInAnyWorld) {
  for (const glm::dvec3 axis : {glm::dvec3(1, 0.2, 0), glm::dvec3(0, 1, 0.5), glm::dvec3(0.3, 0.2, 1)})
    for (const double angle : {0.7, 1.6, 2.9}) {
      PhotographSet set = with_points(6);
      const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), angle, glm::normalize(axis)));
      transform(set, turn, 0.3, {5.0, -2.0, 1.0});
      const auto up = up_of_cameras(set);
      ASSERT_TRUE(up);
      EXPECT_GT(glm::dot(*up, turn * glm::dvec3(0, 0, 1)), std::cos(glm::radians(0.5)));
      make_z_up(set, false);
      EXPECT_GT(up_of_cameras(set)->z, std::cos(glm::radians(0.5)));
    }
}

TEST(Alignment, PicturesHeldUprightCountAsLevel) {
  PhotographSet set = with_points(6);
  for (const std::size_t i : {0, 3}) {
    const glm::dmat4 pose = set.photographs[i].world_from_camera;
    set.photographs[i].world_from_camera[0] = pose[1];
    set.photographs[i].world_from_camera[1] = -pose[0];
  }
  EXPECT_GT(up_of_cameras(set)->z, std::cos(glm::radians(0.5)));
}

TEST(Alignment, PicturesAllHeldUprightAreLevelAsExifSays) {
  for (const auto& [orientation, quarters] : {std::pair(6, 1), std::pair(3, 2), std::pair(8, 3)}) {
    PhotographSet set = with_points(6);
    for (Photograph& photograph : set.photographs) {
      photograph.orientation = orientation;
      for (int i = 0; i < quarters; ++i) {  // the camera turned with its right side down
        const glm::dmat4 pose = photograph.world_from_camera;
        photograph.world_from_camera[0] = -pose[1], photograph.world_from_camera[1] = pose[0];
      }
    }
    const auto up = up_of_cameras(set);
    ASSERT_TRUE(up);
    EXPECT_GT(up->z, std::cos(glm::radians(0.5))) << orientation;
  }
}

TEST(Alignment, AMeasuredFrameIsTurnedByWholeQuarters) {
  PhotographSet set = with_points(6);
  const glm::dvec3 before = set.points[7].position_in_world;
  transform(set, glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, -1), 1.0,
            glm::dvec3(0.0));  // as the courtyard's: up is -z
  make_z_up(set, true);
  EXPECT_EQ(set.points[7].position_in_world, before);
}

TEST(Alignment, TransformsKeepPixels) {
  PhotographSet set = with_points(5);
  transform(set, glm::dmat3(glm::rotate(glm::dmat4(1.0), 1.0, glm::dvec3(0.6, 0.0, 0.8))), 3.0,
            {1.0, 2.0, 3.0});
  for (const SparsePoint& point : set.points)
    for (const Observation& o : point.observations)
      EXPECT_LT(
          glm::distance(*pixel_of_world(set.photographs[std::size_t(o.photograph)], point.position_in_world),
                        o.pixel),
          1e-3);
}

TEST(Alignment, WhatWasMeasuredInTheFrameOfTheCamerasFollowsThem) {
  PhotographSet set = with_points(5);
  const glm::dvec3 before = set.points[7].position_in_world;
  transform(set, glm::dmat3(glm::rotate(glm::dmat4(1.0), 1.0, glm::dvec3(0.6, 0.0, 0.8))), 3.0,
            {1.0, 2.0, 3.0});
  make_z_up(set, false);
  EXPECT_GT(glm::distance(set.points[7].position_in_world, before), 0.1);
  EXPECT_LT(glm::distance(glm::dvec3(set.world_from_given * glm::dvec4(before, 1.0)),
                          set.points[7].position_in_world),
            1e-9);
}

TEST(Alignment, DistancesGiveTheScale) {
  const PhotographSet set = with_points(3);
  const double between =
      glm::distance(set.photographs[0].position_in_world(), set.photographs[2].position_in_world());
  const auto scale = scale_of_distance(set, "place_0.png", "place_2.png", 2.0 * between);
  ASSERT_TRUE(scale);
  EXPECT_NEAR(*scale, 2.0, 1e-9);
  const auto missing = scale_of_distance(set, "place_0.png", "other.png", 1.0);
  ASSERT_FALSE(missing);
  EXPECT_NE(to_string(missing.errors()).find("other.png"), std::string::npos);
  EXPECT_FALSE(scale_of_distance(set, "place_0.png", "place_0.png", 1.0));
}

TEST(Neighbours, TheCameraThatIsWrongIsNamed) {
  PhotographSet set = with_points(7);
  EXPECT_TRUE(cameras_that_do_not_fit(set).empty()) << to_string(cameras_that_do_not_fit(set));
  set.photographs[3].world_from_camera[3] += glm::dvec4(0.3, 0.0, 0.0, 0.0);
  const Errors wrong = cameras_that_do_not_fit(set);
  ASSERT_EQ(wrong.size(), 1u) << to_string(wrong);
  EXPECT_NE(wrong[0].message.find("place_3.png: its camera does not fit"), std::string::npos);
  const Errors left_out = leave_out_what_does_not_fit(set);
  ASSERT_EQ(left_out.size(), 1u) << to_string(left_out);
  EXPECT_NE(left_out[0].message.find("it is left out"), std::string::npos);
  ASSERT_EQ(set.photographs.size(), 6u);
  EXPECT_EQ(find(set, "place_3.png"), nullptr);
  EXPECT_EQ(set.photographs[3].name, "place_4.png");
  EXPECT_TRUE(cameras_that_do_not_fit(set).empty()) << "points name the photographs that are left";
  EXPECT_TRUE(leave_out_what_does_not_fit(set).empty());
}

TEST(Neighbours, APhotographOfAnotherPlaceHasNone) {
  PhotographSet set = with_points(5);
  for (SparsePoint& point : set.points)
    std::erase_if(point.observations, [](const Observation& o) { return o.photograph == 2; });
  const Errors wrong = cameras_that_do_not_fit(set);
  ASSERT_EQ(wrong.size(), 1u) << to_string(wrong);
  EXPECT_NE(wrong[0].message.find("place_2.png: has no neighbours"), std::string::npos);
}

}  // namespace
}  // namespace parvis::photographs
