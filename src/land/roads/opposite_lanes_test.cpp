#include "land/roads/opposite_lanes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "land/roads/road_builder.h"
#include "scene/data/path.h"

namespace parvis::scene {
namespace {

/// Every lane against every other one.
bool has_opposite(const RoadGraph& roads, const Lane& lane) {
  const MeasuredPath path(lane.points);
  const float middle_m = 0.5f * path.length();
  const glm::vec3 direction = path.direction_at(middle_m);
  const glm::vec2 expected(path.at(middle_m) - right_of(direction) * lane.width_m);
  return std::ranges::any_of(roads.lanes, [&](const Lane& other) {
    if (other.crossing >= 0 || &other == &lane) return false;
    for (std::size_t i = 0; i + 1 < other.points.size(); ++i) {
      const glm::vec2 a(other.points[i]), along = glm::vec2(other.points[i + 1]) - a;
      const float fraction = std::clamp(glm::dot(expected - a, along) / glm::dot(along, along), 0.0f, 1.0f);
      if (glm::distance(a + fraction * along, expected) < 0.3f * lane.width_m &&
          glm::dot(along, glm::vec2(direction)) < 0.0f)
        return true;
    }
    return false;
  });
}

TEST(OppositeLanes, TheGridFindsWhatALookAtAllLanesFinds) {
  Random random(3);
  std::vector<Road> roads;
  for (int i = 0; i < 30; ++i) {
    Road& road = roads.emplace_back();
    const glm::vec3 from(random.uniform(-400.0f, 400.0f), random.uniform(-400.0f, 400.0f), 0.0f);
    const float angle = 0.1f * float(i);  // so that no two of them lie along each other
    road.path = {from,
                 from + random.uniform(20.0f, 500.0f) * glm::vec3(std::cos(angle), std::sin(angle), 0.0f)};
    road.lanes_each_way = 1 + i % 3, road.is_one_way = i % 4 == 0;
    road.lane_width_m = random.uniform(2.0f, 6.0f);
  }
  const Result<RoadGraph> graph = build_road_graph(roads);
  ASSERT_TRUE(graph) << to_string(graph.errors());
  const OppositeLanes opposite(*graph);
  std::size_t found = 0, lanes = 0;
  for (const Lane& lane : graph->lanes) {
    if (lane.crossing >= 0) continue;
    EXPECT_EQ(opposite.has(lane), has_opposite(*graph, lane)) << lanes;
    found += opposite.has(lane), ++lanes;
  }
  EXPECT_GT(found, lanes / 10);
  EXPECT_LT(found, lanes);
}

TEST(RoadNetworkLimits, WhatNoTownHasIsRefusedInAFewWords) {
  const auto complaint = [](const std::vector<Road>& roads) {
    const Result<RoadGraph> graph = build_road_graph(roads);
    return graph ? std::string() : to_string(graph.errors());
  };
  const auto road = [](glm::vec3 from, glm::vec3 to) {
    Road made;
    made.path = {from, to};
    return made;
  };
  const std::vector<Road> equal(500, road({0, 0, 0}, {100, 0, 0}));
  const std::string along = complaint(equal);
  EXPECT_NE(along.find("lies along"), std::string::npos) << along;
  EXPECT_EQ(std::ranges::count(along, '\n'), 20) << along;
  std::vector<Road> star;
  for (int i = 0; i < 100; ++i) {
    const float angle = 0.0628f * float(i);
    star.push_back(road({0, 0, 0}, 900.0f * glm::vec3(std::cos(angle), std::sin(angle), 0.0f)));
  }
  EXPECT_NE(complaint(star).find("too many for a crossing"), std::string::npos) << complaint(star);
  std::vector<Road> far;
  for (int i = 0; i < 20; ++i)
    far.push_back(road({-1e6f, 100.0f * float(i), 0}, {1e6f, 100.0f * float(i), 0}));
  EXPECT_NE(complaint(far).find("km of lanes"), std::string::npos) << complaint(far);
  EXPECT_EQ(complaint({road({0, 0, 0}, {100, 0, 0}), road({50, -50, 0}, {50, 50, 0})}), "");
}

}  // namespace
}  // namespace parvis::scene
