#include "land/roads/earthworks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace parvis::scene {
namespace {

constexpr float works_half_m = 6.0f;

RoadBed bed(const std::vector<glm::vec3>& path, Bed kind = Bed::earth) {
  RoadBed result;
  result.half_m = works_half_m;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const int steps = int(std::ceil(glm::distance(path[i], path[i + 1]) / 10.0f));
    for (int k = i == 0 ? 0 : 1; k <= steps; ++k)
      result.points.push_back({glm::mix(path[i], path[i + 1], float(k) / float(steps)), kind});
  }
  return result;
}

/// Calls use(point) for places every half metre in a square about the origin.
template <class Use>
void each_place(float reach_m, const Use& use) {
  const int steps = int(2.0f * reach_m);
  for (int y = -steps; y <= steps; ++y)
    for (int x = -steps; x <= steps; ++x) use(0.5f * glm::vec2(x, y));
}

TEST(Earthworks, MakeABedLevelFromSideToSideAndLeaveTheRestOfTheHillside) {
  const std::vector beds{bed({{-200, 0, 0}, {200, 0, 20}})};
  const Earthworks works(beds);
  const auto hillside_m = [](glm::vec2 p) { return 10.0f + 0.05f * p.x + 0.25f * p.y; };
  for (const float x : {-40.0f, 0.0f, 33.0f})
    for (const float y : {-6.0f, -3.0f, 0.0f, 3.0f, 6.0f})
      EXPECT_NEAR(works.at({x, y}, hillside_m({x, y})), 10.0f + 0.05f * x, 0.02f) << x << " " << y;
  EXPECT_LT(works.at({0, 7}, hillside_m({0, 7})), hillside_m({0, 7}) - 0.5f) << "a cut above the road";
  EXPECT_GT(works.at({0, -7}, hillside_m({0, -7})), hillside_m({0, -7}) + 0.5f) << "a dam below it";
  for (const float y : {-40.0f, -24.5f, 24.5f, 40.0f})
    EXPECT_EQ(works.at({0, y}, hillside_m({0, y})), hillside_m({0, y})) << y;
  EXPECT_FALSE(works.may_change({-50, 60}, {50, 90}));
  EXPECT_TRUE(works.may_change({-50, 10}, {50, 90}));
}

TEST(Earthworks, SlopesOfEarthAreNoSteeperThanTheyStand) {
  const std::vector beds{bed({{-200, 0, 0}, {200, 0, 0}})};
  const Earthworks works(beds);
  for (const float level_m : {-3.0f, 3.0f}) {  // the road in a cut and on a dam
    float steepest = 0.0f;
    each_place(30.0f, [&](glm::vec2 p) {
      const glm::vec2 next = p + glm::vec2(0.0f, 0.5f);
      steepest = std::max(steepest, std::abs(works.at(next, level_m) - works.at(p, level_m)) / 0.5f);
    });
    EXPECT_NEAR(steepest, Earthworks::slope, 1e-3f) << level_m;
  }
}

TEST(Earthworks, RunOutWithoutAStepWhereAHillsideIsSteeperThanTheirSlopes) {
  const std::vector beds{bed({{-200, 0, 0}, {200, 0, 0}})};
  const Earthworks works(beds);
  each_place(40.0f, [&](glm::vec2 p) {
    const glm::vec2 next = p + glm::vec2(0.0f, 0.05f);
    EXPECT_LT(std::abs(works.at(next, 0.7f * next.y) - works.at(p, 0.7f * p.y)), 0.6f) << p.y;
  });
}

TEST(Earthworks, BedsThatMeetAreBlendedWithoutAStep) {
  const std::vector beds{bed({{-100, 0, -10}, {100, 0, 10}}), bed({{0, -100, 0}, {0, 100, 0}})};
  const Earthworks works(beds);
  each_place(25.0f, [&](glm::vec2 p) {
    for (const glm::vec2 step : {glm::vec2(0.5f, 0.0f), glm::vec2(0.0f, 0.5f)})
      EXPECT_LT(std::abs(works.at(p + step, 0.0f) - works.at(p, 0.0f)), 0.5f) << p.x << " " << p.y;
  });
  EXPECT_NEAR(works.at({0, 0}, 1.0f), 0.0f, 1e-3f);
  EXPECT_NEAR(works.at({40, 0}, 1.0f), 4.0f, 1e-3f) << "each has its own height away from the other";
  for (const float x : {2.0f, 4.0f, 8.0f, 12.0f})
    EXPECT_NEAR(works.at({x, 0}, 0.0f), 0.1f * x, 0.12f) << "the slope along a street goes on";
}

TEST(Earthworks, SlopesBeginBeyondTheTurnsThatRoundACorner) {
  const RoadBed east = bed({{-100, 0, 0}, {100, 0, 0}}), north = bed({{0, -100, 0}, {0, 100, 0}});
  RoadBed turn = bed({{16, 2, 5}, {6, 6, 5}, {2, 16, 5}});
  turn.is_turn = true;
  const std::vector sharp{east, north}, round{east, north, turn};
  const glm::vec2 in_corner(8.5f, 8.5f), elsewhere(-8.5f, 8.5f);
  EXPECT_GT(Earthworks(sharp).at(in_corner, 3.0f), 1.0f) << "control: 2.5 m beside both beds";
  EXPECT_NEAR(Earthworks(round).at(in_corner, 3.0f), 0.0f, 1e-3f)
      << "at the height of the roads, not of the turn";
  EXPECT_FLOAT_EQ(Earthworks(round).at(elsewhere, 3.0f), Earthworks(sharp).at(elsewhere, 3.0f));
  EXPECT_EQ(Earthworks(std::vector{turn}).at({6, 6}, 3.0f), 3.0f) << "a turn alone shapes nothing";
}

TEST(Earthworks, ARoadInSeveralPiecesHasOneSlope) {
  const std::vector beds{bed({{-100, 0, -10}, {0, 0, 0}}), bed({{0, 0, 0}, {100, 0, 10}})};
  const Earthworks works(beds);
  for (float x = -20.0f; x < 20.5f; x += 1.0f) EXPECT_NEAR(works.at({x, 0}, 0.0f), 0.1f * x, 0.1f) << x;
}

TEST(Earthworks, BelowADeckTheGroundIsCutAndNeverRaised) {
  const std::vector beds{bed({{-50, 0, 2}, {50, 0, 2}}, Bed::cut)};
  const Earthworks works(beds);
  EXPECT_EQ(works.at({0, 0}, -3.0f), -3.0f);
  EXPECT_FLOAT_EQ(works.at({0, 3}, 3.0f), 2.0f);
  EXPECT_FALSE(
      Earthworks(std::vector{bed({{-50, 0, 2}, {50, 0, 2}}, Bed::none)}).may_change({-9, -9}, {9, 9}));
}

TEST(Earthworks, ADamBesideADeckStaysWhereItIs) {
  const RoadBed dam = bed({{-100, 0, 2}, {100, 0, 2}});
  const std::vector alone{dam}, both{dam, bed({{-100, 16, 6}, {100, 16, 6}}, Bed::cut)};
  EXPECT_FLOAT_EQ(Earthworks(both).at({0, 7}, 0.0f), Earthworks(alone).at({0, 7}, 0.0f));
}

TEST(Earthworks, EndsOfRoadsHaveRoomToTurnRound) {
  const std::vector beds{bed({{0, 0, 0}, {100, 0, 0}})};
  const Earthworks works(beds);
  EXPECT_EQ(works.at({97, 8}, 1.0f), 0.0f);
  EXPECT_GT(works.at({50, 8}, 2.0f), 0.5f) << "control: in the middle the slope begins after 6 m";
}

}  // namespace
}  // namespace parvis::scene
