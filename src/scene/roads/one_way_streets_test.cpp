#include "scene/roads/one_way_streets.h"

#include <gtest/gtest.h>

namespace parvis::scene {
namespace {

constexpr float car_lane_m = 2.35f;
const glm::vec3 west{0, 0, 0}, east{100, 0, 0}, north{50, 80, 0}, far_east{200, 0, 0};

Road street(glm::vec3 from, glm::vec3 to, float lane_width_m) {
  Road road;
  road.path = {from, to};
  road.lane_width_m = lane_width_m;
  return road;
}

TEST(OneWayStreets, ARingOfNarrowStreetsTurnsOneWay) {
  std::vector<Road> roads{street(west, east, 1.2f), street(north, east, 1.2f), street(north, west, 1.2f)};
  make_narrow_streets_one_way(roads, car_lane_m);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(roads[i].is_one_way);
    EXPECT_FLOAT_EQ(roads[i].lane_width_m, 2.4f);
    EXPECT_EQ(roads[i].path.back(), roads[(i + 1) % 3].path.front()) << "one follows the other";
  }
}

TEST(OneWayStreets, TheOnlyWayToAPlaceStaysOpenBothWays) {
  std::vector<Road> roads{street(west, east, 3.0f), street(north, east, 3.0f), street(north, west, 1.0f),
                          street(east, far_east, 1.2f)};
  make_narrow_streets_one_way(roads, car_lane_m);
  EXPECT_FALSE(roads[0].is_one_way || roads[1].is_one_way) << "wide enough for two";
  EXPECT_TRUE(roads[2].is_one_way);
  EXPECT_FALSE(roads[3].is_one_way) << "who drives to its end must come back";
  EXPECT_FLOAT_EQ(roads[3].lane_width_m, car_lane_m);
}

}  // namespace
}  // namespace parvis::scene
