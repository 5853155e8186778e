#include "land/roads/road_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "scene/data/path.h"

namespace parvis::scene {
namespace {

Road road(std::vector<glm::vec3> path, int lanes = 1) {
  Road result;
  result.path = std::move(path);
  result.lanes_each_way = lanes;
  return result;
}

RoadGraph built(const std::vector<Road>& roads) {
  Result<RoadGraph> graph = build_road_graph(roads);
  EXPECT_TRUE(graph.ok()) << to_string(graph.errors());
  return graph.ok() ? std::move(*graph) : RoadGraph{};
}

/// Lanes begin where their predecessors end, in the same direction, and hold no repeated points.
void expect_smooth(const RoadGraph& graph) {
  for (const Lane& lane : graph.lanes) {
    ASSERT_GE(lane.points.size(), 2u);
    EXPECT_EQ(lane.points.size(), without_repeats(lane.points).size());
    const MeasuredPath path(lane.points);
    for (const int next : lane.next) {
      const MeasuredPath after(graph.lanes[std::size_t(next)].points);
      EXPECT_LT(glm::distance(lane.points.back(), after.points().front()), 0.01f);
      EXPECT_GT(glm::dot(path.direction_at(path.length()), after.direction_at(0.0f)), std::cos(0.2f));
    }
    for (std::size_t i = 2; i < lane.points.size(); ++i) {
      const glm::vec3 a = glm::normalize(lane.points[i - 1] - lane.points[i - 2]);
      const glm::vec3 b = glm::normalize(lane.points[i] - lane.points[i - 1]);
      EXPECT_GT(glm::dot(a, b), std::cos(0.35f));
    }
  }
}

void expect_ways_on(const RoadGraph& graph) {
  for (const Lane& lane : graph.lanes) EXPECT_FALSE(lane.next.empty());
}

std::size_t count_turns(const RoadGraph& graph) {
  return std::size_t(std::ranges::count_if(graph.lanes, [](const Lane& lane) { return lane.crossing >= 0; }));
}

TEST(MeasuredPath, PartsFarFromTheOriginRepeatNoPoint) {
  // Floats know 40 km to 4 mm: the end of the part is the point before it, in numbers.
  const MeasuredPath path({{40000, 0, 0}, {40003, 0, 0}, {40003.00390625f, 0, 0}, {40010, 0, 0}});
  for (const float to : {3.0015f, 3.005f, 6.0f}) {
    const Path part = path.part(0.0f, to);
    ASSERT_GE(part.size(), 2u);
    EXPECT_EQ(part.size(), without_repeats(part).size()) << to;
    EXPECT_EQ(part.back(), path.at(to));
  }
}

TEST(RoadBuilder, TrafficKeepsRight) {
  const RoadGraph graph = built({road({{0, 0, 0}, {100, 0, 0}})});
  for (const Lane& lane : graph.lanes) {
    if (lane.crossing >= 0) continue;
    const bool goes_east = lane.points.back().x > lane.points.front().x;
    EXPECT_NEAR(lane.points.front().y, goes_east ? -1.5f : 1.5f, 1e-4f);
  }
}

TEST(RoadBuilder, CrossingHasTwelveTurns) {
  const RoadGraph graph = built({road({{-100, 0, 0}, {100, 0, 0}}), road({{0, -100, 0}, {0, 100, 0}})});
  EXPECT_EQ(graph.lanes.size(), 8u + 12u + 4u);  // lanes, turns, four dead ends
  EXPECT_EQ(count_turns(graph), 16u);
  expect_smooth(graph);
  expect_ways_on(graph);
}

TEST(RoadBuilder, EndsOnAnotherRoadJoinIt) {
  const RoadGraph graph = built({road({{-100, 0, 0}, {100, 0, 0}}), road({{0, -100, 0}, {0, -2.5f, 0}})});
  EXPECT_EQ(count_turns(graph), 6u + 3u);
  expect_smooth(graph);
  expect_ways_on(graph);
}

TEST(RoadBuilder, EndsThatMeetGoOn) {
  const RoadGraph graph = built({road({{0, 0, 0}, {100, 0, 0}}), road({{101, 1, 0}, {150, 80, 0}})});
  EXPECT_EQ(count_turns(graph), 2u + 2u);
  expect_smooth(graph);
}

TEST(RoadBuilder, SeveralLanesEachTurnFromTheirOwn) {
  const RoadGraph graph = built({road({{-150, 0, 0}, {150, 0, 0}}, 3), road({{0, -150, 0}, {0, 0, 0}}, 3)});
  expect_smooth(graph);
  expect_ways_on(graph);  // the middle lane of the stem too
}

TEST(RoadBuilder, RingHasNoEnd) {
  const RoadGraph graph = built({road({{0, 0, 0}, {100, 0, 0}, {100, 100, 0}, {0, 100, 0}, {0, 0, 0}})});
  EXPECT_EQ(graph.lanes.size(), 4u);
  expect_smooth(graph);
  expect_ways_on(graph);
}

TEST(RoadBuilder, BendsAreRounded) {
  const RoadGraph graph = built({road({{0, 0, 0}, {60, 0, 0}, {60, 60, 0}, {120, 60, 0}}, 2)});
  expect_smooth(graph);
}

TEST(RoadBuilder, SelfCrossingIsACrossing) {
  const RoadGraph graph = built({road({{-80, 0, 0}, {80, 0, 0}, {80, 80, 0}, {0, 80, 0}, {0, -80, 0}})});
  EXPECT_EQ(count_turns(graph), 12u + 2u);
  expect_smooth(graph);
  expect_ways_on(graph);
}

TEST(RoadBuilder, BridgesPassOver) {
  const RoadGraph graph = built({road({{-100, 0, 0}, {100, 0, 0}}), road({{0, -100, 6}, {0, 100, 6}})});
  EXPECT_EQ(count_turns(graph), 4u);
}

TEST(RoadBuilder, LanesFollowTheSlope) {
  const RoadGraph graph = built({road({{0, 0, 0}, {200, 0, 20}})});
  for (const Lane& lane : graph.lanes)
    for (const glm::vec3& p : lane.points) EXPECT_NEAR(p.z, 0.1f * p.x, 0.1f);
}

TEST(RoadBuilder, OneWayRunsForward) {
  Road one_way = road({{0, 0, 0}, {100, 0, 0}}, 2);
  one_way.is_one_way = true;
  const RoadGraph graph = built({one_way});
  ASSERT_EQ(graph.lanes.size(), 2u);
  for (const Lane& lane : graph.lanes) EXPECT_GT(lane.points.back().x, lane.points.front().x);
  EXPECT_NEAR(graph.lanes[0].points[0].y + graph.lanes[1].points[0].y, 0.0f, 1e-4f);
}

TEST(RoadBuilder, ShortStreetsAndAcuteAnglesStaySmooth) {
  expect_ways_on(built({road({{-50, 0, 0}, {50, 0, 0}}), road({{0, -50, 0}, {0, 50, 0}}),
                        road({{10, -50, 0}, {10, 50, 0}}), road({{-50, -8, 0}, {50, 12, 0}})}));
  expect_ways_on(built({road({{0, 0, 0}, {1, 0, 0}})}));
}

TEST(RoadBuilder, NoRoadsGiveAnEmptyGraph) { EXPECT_TRUE(built({}).empty()); }

TEST(RoadBuilder, BadRoadsAreNamed) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::vector<Road> roads{road({{0, 0, 0}, {nan, 0, 0}}),
                          road({{5, 5, 0}}),
                          road({{5, 5, 0}, {5, 5, 0}}),
                          road({}),
                          road({{0, 0, 0}, {50, 0, 0}, {20, 0, 0}}),
                          road({{0, 0, 0}, {9, 0, 0}}, 0)};
  for (std::size_t i = 0; i < roads.size(); ++i) roads[i].where = {"square.xp", int(i) + 1, 1};
  const Result<RoadGraph> graph = build_road_graph(roads);
  ASSERT_FALSE(graph.ok());
  ASSERT_EQ(graph.errors().size(), roads.size());
  for (std::size_t i = 0; i < roads.size(); ++i) EXPECT_EQ(graph.errors()[i].where.line, int(i) + 1);
}

TEST(RoadBuilder, CoincidentRoadsAreRefused) {
  const Result<RoadGraph> graph =
      build_road_graph(std::vector{road({{0, 0, 0}, {100, 0, 0}}), road({{120, 0.2f, 0}, {20, 0, 0}})});
  ASSERT_FALSE(graph.ok());
  EXPECT_NE(graph.errors()[0].message.find("lies along"), std::string::npos);
}

TEST(RoadBuilder, EachRoadThatLiesAlongAnEarlierOneIsNamedOnceWhereAllAreAskedFor) {
  std::vector<Road> roads(100, road({{0, 0, 0}, {100, 0, 0}}));
  for (std::size_t i = 0; i < roads.size(); ++i) roads[i].where = {"square.xp", int(i) + 1, 1};
  const Result<RoadGraph> graph = build_road_graph(roads, roads.size() + 1);
  ASSERT_FALSE(graph.ok());
  std::set<int> lines;
  for (const Error& problem : graph.errors()) lines.insert(problem.where.line);
  EXPECT_EQ(graph.errors().size(), 99u);
  EXPECT_EQ(lines.size(), 99u);
  EXPECT_FALSE(lines.contains(1)) << "the first one stays";
}

}  // namespace
}  // namespace parvis::scene
