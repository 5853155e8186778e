#include "land/roads/one_way_streets.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace parvis::scene {
namespace {

constexpr float car_lane_m = 2.35f;
const glm::vec3 west_end{0, 0, 0}, east_end{100, 0, 0}, north_end{50, 80, 0}, far_east{200, 0, 0};

Road street(glm::vec3 from, glm::vec3 to, float lane_width_m) {
  Road road;
  road.path = {from, to};
  road.lane_width_m = lane_width_m;
  return road;
}

TEST(OneWayStreets, ARingOfNarrowStreetsTurnsOneWay) {
  std::vector<Road> roads{street(west_end, east_end, 1.2f), street(north_end, east_end, 1.2f),
                          street(north_end, west_end, 1.2f)};
  make_narrow_streets_one_way(roads, car_lane_m);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(roads[i].is_one_way);
    EXPECT_FLOAT_EQ(roads[i].lane_width_m, 2.4f);
    EXPECT_EQ(roads[i].path.back(), roads[(i + 1) % 3].path.front()) << "one follows the other";
  }
}

TEST(OneWayStreets, TheOnlyWayToAPlaceStaysOpenBothWays) {
  std::vector<Road> roads{street(west_end, east_end, 3.0f), street(north_end, east_end, 3.0f),
                          street(north_end, west_end, 1.0f), street(east_end, far_east, 1.2f)};
  make_narrow_streets_one_way(roads, car_lane_m);
  EXPECT_FALSE(roads[0].is_one_way || roads[1].is_one_way) << "wide enough for two";
  EXPECT_TRUE(roads[2].is_one_way);
  EXPECT_FALSE(roads[3].is_one_way) << "who drives to its end must come back";
  EXPECT_FLOAT_EQ(roads[3].lane_width_m, car_lane_m);
}

/// Places that can be reached from the start of the first road.
std::size_t reached_places(const std::vector<Road>& roads) {
  std::vector<glm::vec3> reached{roads.front().path.front()};
  for (std::size_t i = 0; i < reached.size(); ++i)
    for (const Road& road : roads)
      for (const bool is_back : {false, true}) {
        if (is_back && road.is_one_way) continue;
        const glm::vec3 from = is_back ? road.path.back() : road.path.front(),
                        to = is_back ? road.path.front() : road.path.back();
        if (from == reached[i] && std::ranges::find(reached, to) == reached.end()) reached.push_back(to);
      }
  return reached.size();
}

TEST(OneWayStreets, InAGridOfThemOneStillGetsEverywhere) {
  constexpr int side = 12;
  const auto place = [](int x, int y) { return glm::vec3(float(50 * x), float(50 * y), 0.0f); };
  std::vector<Road> roads;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      if (x > 0) roads.push_back(street(place(x - 1, y), place(x, y), 1.2f));
      if (y > 0) roads.push_back(street(place(x, y - 1), place(x, y), 1.2f));
    }
  roads.push_back(street(place(3, 0), {150, -80, 0}, 1.2f));
  make_narrow_streets_one_way(roads, car_lane_m);
  const auto one_way = std::ranges::count_if(roads, &Road::is_one_way);
  EXPECT_GT(one_way, std::ptrdiff_t(roads.size() / 2));
  EXPECT_FALSE(roads.back().is_one_way) << "a dead end";
  for (int i = 0; i < side; ++i) {
    EXPECT_EQ(reached_places(roads), std::size_t(side * side + 1));
    std::ranges::rotate(roads, roads.begin() + std::ptrdiff_t(roads.size() / side));
  }
}

}  // namespace
}  // namespace parvis::scene
