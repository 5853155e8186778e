#include "life/crowd/crowd.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace parvis::crowd {
namespace {

/// Ground of rectangles and slopes.
struct TestGround : WalkingGround {
  void quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d, GroundKind kind = GroundKind::floor) {
    for (const glm::vec3 p : {a, b, c, a, c, d}) corners.push_back(p);
    kinds.insert(kinds.end(), 2, kind);
  }
  void rectangle(glm::vec2 low, glm::vec2 high, float z = 0.0f, GroundKind kind = GroundKind::floor) {
    quad({low, z}, {high.x, low.y, z}, {high, z}, {low.x, high.y, z}, kind);
  }
  void block(glm::vec2 low, glm::vec2 high, float top) {
    rectangle(low, high, top, GroundKind::obstacle);
    const std::array<glm::vec2, 4> c{low, {high.x, low.y}, high, {low.x, high.y}};
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::vec2 a = c[i], b = c[(i + 1) % 4];
      quad({a, 0}, {b, 0}, {b, top}, {a, top}, GroundKind::obstacle);
    }
  }
};

constexpr float step_s = 0.1f, radius_m = 0.19f;

/// A crowd of bodies of 0.15 m, on cells of 5 cm: doors of the tests keep their width.
Crowd crowd_on(const WalkingGround& ground) {
  Result<NavMesh> mesh = NavMesh::create(ground, {.cell_m = 0.05f, .body_radius_m = 0.15f});
  EXPECT_TRUE(mesh) << (mesh ? "" : to_string(mesh.errors()));
  return Crowd(*std::move(mesh));
}

/// Adds people at random places of a rectangle, 0.4 m apart.
void fill(Crowd& crowd, glm::vec2 low, glm::vec2 high, int people, int destination, float speed = 1.33f) {
  Random random(7);
  std::vector<glm::vec2> taken;
  for (int tries = 0; int(taken.size()) < people && tries < 100'000; ++tries) {
    const glm::vec2 p(random.uniform(low.x, high.x), random.uniform(low.y, high.y));
    const auto is_near = [&](glm::vec2 other) { return glm::distance(p, other) < 0.4f; };
    if (std::ranges::none_of(taken, is_near) && crowd.add({p, 0}, destination, speed, radius_m))
      taken.push_back(p);
  }
  ASSERT_EQ(int(taken.size()), people);
}

/// Lets who has arrived leave; returns how many.
int let_out(Crowd& crowd) {
  int left = 0;
  for (std::size_t i = crowd.size(); i-- > 0;)
    if (crowd.people()[i].has_arrived) crowd.remove(i), ++left;
  return left;
}

/// Seconds until all have left; 1e9 where they do not within `limit_s`.
float seconds_to_empty(Crowd& crowd, float limit_s) {
  float time_s = 0.0f;
  for (; crowd.size() > 0 && time_s < limit_s; time_s += step_s) crowd.step(step_s), let_out(crowd);
  return crowd.size() == 0 ? time_s : 1e9f;
}

TEST(Crowd, OnePersonKeepsTheSpeedAlongACorridor) {  // RiMEA 3.0, test 1
  TestGround ground;
  ground.rectangle({-2, 0}, {42, 2});
  Crowd crowd = crowd_on(ground);
  crowd.add({-1, 1, 0}, crowd.add(Destination{{40, 0, 0}, {40, 2, 0}, 0.05f}), 1.33f, radius_m);
  EXPECT_NEAR(seconds_to_empty(crowd, 100.0f), 41.0f / 1.33f, 1.0f);
}

TEST(Crowd, StairsAreWalkedAtTheGivenSpeedAlongTheSlope) {  // RiMEA 3.0, tests 2 and 3
  for (const bool up : {true, false}) {
    TestGround ground;
    ground.rectangle({-2, 0}, {0, 2});
    ground.quad({0, 0, 0}, {8, 0, 6}, {8, 2, 6}, {0, 2, 0});
    ground.rectangle({8, 0}, {10, 2}, 6);
    Crowd crowd = crowd_on(ground);
    const float speed = up ? 0.5f : 0.65f, end = up ? 9.7f : -1.7f, z = up ? 6.0f : 0.0f;
    const int destination = crowd.add(Destination{{end, 0, z}, {end, 2, z}, 0.1f});
    ASSERT_TRUE(crowd.add(up ? glm::vec3(-1, 1, 0) : glm::vec3(9, 1, 6), destination, speed, radius_m));
    float from_s = -1.0f, to_s = -1.0f;
    for (float time_s = 0.0f; time_s < 60.0f && to_s < 0.0f; time_s += step_s) {
      crowd.step(step_s);
      const float x = up ? crowd.walkers().position[0].x : 8.0f - crowd.walkers().position[0].x;
      if (from_s < 0.0f && x >= 0.0f) from_s = time_s;
      if (x >= 8.0f) to_s = time_s;
    }
    EXPECT_NEAR(to_s - from_s, 10.0f / speed, 0.05f * 10.0f / speed) << (up ? "up" : "down");
  }
}

TEST(Crowd, NobodyCutsACornerOrWalksThroughABlock) {  // RiMEA 3.0, test 6
  TestGround ground;
  ground.rectangle({0, 0}, {12, 2});
  ground.rectangle({10, 2}, {12, 12});
  ground.block({4, 0.6f}, {5, 1.1f}, 1.0f);
  Crowd crowd = crowd_on(ground);
  fill(crowd, {0.3f, 0.3f}, {3.5f, 1.7f}, 15, crowd.add(Destination{{10, 12, 0}, {12, 12, 0}}));
  int inside = 0;
  for (int s = 0; s < 600 && crowd.size() > 0; ++s) {
    crowd.step(step_s);
    for (const glm::vec2 p : crowd.walkers().position)
      inside += (p.x < 10 && p.y > 2) || (p.x > 4 && p.x < 5 && p.y > 0.6f && p.y < 1.1f) ? 1 : 0;
    let_out(crowd);
  }
  EXPECT_EQ(inside, 0);
  EXPECT_EQ(crowd.size(), 0u) << "all arrive";
}

TEST(Crowd, HalfTheDoorsTakeTwiceTheTime) {  // after RiMEA 3.0, test 9, with a quarter of its people
  const auto seconds = [](bool four) {
    TestGround ground;
    ground.rectangle({0, 0}, {16, 10});
    Crowd crowd = [&] {
      for (const float x : {3.0f, 12.0f}) {
        ground.rectangle({x, -1.6f}, {x + 1, 0.05f});
        if (four) ground.rectangle({x, 9.95f}, {x + 1, 11.6f});
      }
      return crowd_on(ground);
    }();
    std::vector<int> doors;
    for (const float x : {3.0f, 12.0f}) {
      doors.push_back(crowd.add(Destination{{x, -1.2f, 0}, {x + 1, -1.2f, 0}, 0.3f}));
      if (four) doors.push_back(crowd.add(Destination{{x, 11.2f, 0}, {x + 1, 11.2f, 0}, 0.3f}));
    }
    fill(crowd, {1, 1}, {15, 9}, 240, -1);
    for (std::size_t i = 0; i < crowd.size(); ++i) {
      const auto far = [&](int door) {
        return glm::distance(glm::vec2(crowd.destinations()[std::size_t(door)].a),
                             crowd.walkers().position[i]);
      };
      EXPECT_TRUE(crowd.send(i, *std::ranges::min_element(doors, {}, far)));
    }
    return seconds_to_empty(crowd, 400.0f);
  };
  const float four = seconds(true), two = seconds(false);
  EXPECT_LT(four, 400.0f);
  EXPECT_GT(two / four, 1.6f);
  EXPECT_LT(two / four, 2.4f);
}

TEST(Crowd, PeopleWhoMeetHeadOnPass) {
  TestGround ground;
  ground.rectangle({0, 0}, {20, 1.2f});
  Crowd crowd = crowd_on(ground);
  const int east = crowd.add(Destination{{19.5f, 0, 0}, {19.5f, 1.2f, 0}}),
            west = crowd.add(Destination{{0.5f, 0, 0}, {0.5f, 1.2f, 0}});
  ASSERT_TRUE(crowd.add({2, 0.6f, 0}, east, 1.33f, radius_m));
  ASSERT_TRUE(crowd.add({18, 0.6f, 0}, west, 1.33f, radius_m));
  EXPECT_LT(seconds_to_empty(crowd, 60.0f), 30.0f) << "they do not stand before each other";
}

/// Mean distances of somebody from a slower leader, along and across their way, over a walk of 70 m among
/// others who come the other way.
std::pair<float, float> apart_from_leader(bool accompanies) {
  TestGround ground;
  ground.rectangle({-5, 0}, {80, 8});
  Crowd crowd = crowd_on(ground);
  const int east = crowd.add(Destination{{78, 0, 0}, {78, 8, 0}, 0.3f}),
            west = crowd.add(Destination{{-3, 0, 0}, {-3, 8, 0}, 0.3f});
  crowd.add({0, 4, 0}, east, 1.1f, radius_m), crowd.add({0, 4.9f, 0}, east, 1.35f, radius_m);
  if (accompanies) crowd.accompany(1, 0);
  for (int i = 0; i < 12; ++i)
    crowd.add({20.0f + 4.5f * float(i), 1.0f + float((5 * i) % 7), 0}, west, 1.3f, radius_m);
  glm::vec2 sum(0.0f);
  int looks = 0;
  for (int s = 0; s < 600 && !crowd.people()[0].has_arrived && !crowd.people()[1].has_arrived; ++s) {
    crowd.step(step_s);
    if (s < 50) continue;
    sum += glm::abs(crowd.walkers().position[1] - crowd.walkers().position[0]), ++looks;
  }
  return {sum.x / float(looks), sum.y / float(looks)};
}

TEST(Crowd, WhoWalkTogetherKeepAbreast) {
  const auto [along, across] = apart_from_leader(true);
  EXPECT_LT(along, 0.8f);
  EXPECT_NEAR(across, 0.75f, 0.35f);
  EXPECT_GT(apart_from_leader(false).first, 3.0f) << "the control";
}

TEST(Crowd, TheSameCallsGiveTheSamePlaces) {
  const auto places = [] {
    TestGround ground;
    ground.rectangle({0, 0}, {10, 10});
    Crowd crowd = crowd_on(ground);
    fill(crowd, {1, 1}, {4, 9}, 30, crowd.add(Destination{{9.5f, 4, 0}, {9.5f, 6, 0}}));
    for (int s = 0; s < 60; ++s) crowd.step(step_s);
    return crowd.walkers().position;
  };
  EXPECT_EQ(places(), places());
}

TEST(Crowd, AVehicleIsNotWalkedInto) {
  TestGround ground;
  ground.rectangle({0, 0}, {20, 10});
  Crowd crowd = crowd_on(ground);
  fill(crowd, {2, 2}, {8, 8}, 30, crowd.add(Destination{{19, 2, 0}, {19, 8, 0}}));
  const MovingBody car{{12, 3}, {12, 7}, 0.9f};
  float nearest = 1e9f;
  for (int s = 0; s < 200; ++s) {
    crowd.step(step_s, {&car, 1});
    for (const glm::vec2 p : crowd.walkers().position)
      nearest = std::min(nearest, glm::distance(p, nearest_on_segment(car.a, car.b, p)));
    let_out(crowd);
  }
  EXPECT_GT(nearest, car.radius_m + 0.9f * radius_m);
}

TEST(Crowd, AWallThatAppearsIsWalkedRound) {
  TestGround ground;
  ground.rectangle({0, 0}, {20, 10});
  Crowd crowd = crowd_on(ground);
  ASSERT_TRUE(crowd.add({2, 5, 0}, crowd.add(Destination{{18, 5, 0}, {18, 5, 0}}), 1.33f, radius_m));
  for (int s = 0; s < 20; ++s) crowd.step(step_s);
  ground.block({9, 2}, {10, 8}, 2.0f);
  crowd.change_ground(ground, {9, 2}, {10, 8});
  bool went_through = false;
  for (int s = 0; s < 300 && crowd.size() > 0; ++s) {
    crowd.step(step_s);
    const glm::vec2 p = crowd.walkers().position[0];
    went_through = went_through || (p.x > 9 && p.x < 10 && p.y > 2 && p.y < 8);
    let_out(crowd);
  }
  EXPECT_FALSE(went_through);
  EXPECT_EQ(crowd.size(), 0u);
}

TEST(NavMesh, KerbsConnectAndWallsDoNotAtEveryLevelOfTheStreet) {
  for (const float height : {0.05f, 0.12f, 0.15f, 0.2f, 0.31f, 0.4f})
    for (float z = 0.0f; z < 0.2f; z += 0.0173f) {
      TestGround ground;
      ground.rectangle({0, 0}, {10, 5}, z, GroundKind::road);
      ground.rectangle({0, 5}, {10, 10}, z + height);
      ground.rectangle({0, -30}, {10, -20}, z - 7.3f * height);  // the deepest point of the input
      const Result<NavMesh> mesh = NavMesh::create(ground);
      ASSERT_TRUE(mesh);
      EXPECT_EQ(mesh->way({5, 2, z}, {5, 8, z + height}).has_value(), height <= 0.2f)
          << height << " at " << z;
    }
}

TEST(NavMesh, PavementsArePreferredToRoads) {
  TestGround ground;
  ground.rectangle({0, 0}, {30, 20});
  ground.roads = {{{0, 10, 0}, {30, 10, 0}, 8.0f}};
  const Result<NavMesh> mesh = NavMesh::create(ground);
  ASSERT_TRUE(mesh);
  const std::optional<Way> way = mesh->way({2, 5, 0}, {28, 5, 0});
  ASSERT_TRUE(way);
  for (const glm::vec3 corner : *way) EXPECT_LT(corner.y, 6.5f);
  EXPECT_TRUE(mesh->way({2, 5, 0}, {2, 15, 0})) << "and crossed where there is nothing better";
}

TEST(NavMesh, RoadsAreCrossedAtCrossingsAlone) {
  TestGround ground;
  ground.rectangle({0, 0}, {60, 20});
  ground.roads = {{{0, 10, 0}, {60, 10, 0}, 8.0f}};
  ground.crossings = {{{50, 5, 0}, {50, 15, 0}, 4.0f}};
  const Result<NavMesh> mesh = NavMesh::create(ground);
  ASSERT_TRUE(mesh);
  const std::optional<Way> way = mesh->way({2, 3, 0}, {2, 17, 0});
  ASSERT_TRUE(way);
  for (std::size_t i = 0; i + 1 < way->size(); ++i) {  // where the way passes the middle of the road
    const glm::vec3 a = (*way)[i], b = (*way)[i + 1];
    if ((a.y - 10.0f) * (b.y - 10.0f) < 0.0f) {
      EXPECT_NEAR(glm::mix(a.x, b.x, (10.0f - a.y) / (b.y - a.y)), 50.0f, 2.0f);
    }
  }
  EXPECT_FALSE(mesh->nearest({20, 10, 0}, 3.0f)) << "nobody stands on the road";
  EXPECT_TRUE(mesh->nearest({50, 10, 0}, 0.1f));
  EXPECT_NEAR(mesh->area_m2(), 2.0f * 59.5f * 5.5f, 30.0f) << "nor stays on a crossing";
}

TEST(Crowd, WhoIsHeldStands) {
  TestGround ground;
  ground.rectangle({0, 0}, {20, 4});
  Crowd crowd = crowd_on(ground);
  ASSERT_TRUE(crowd.add({2, 2, 0}, crowd.add(Destination{{18, 2, 0}, {18, 2, 0}}), 1.33f, radius_m));
  EXPECT_NEAR(crowd.direction(0).x, 1.0f, 0.05f);
  crowd.hold(0, true);
  for (int s = 0; s < 20; ++s) crowd.step(step_s);
  EXPECT_NEAR(crowd.walkers().position[0].x, 2.0f, 0.01f);
  crowd.hold(0, false);
  for (int s = 0; s < 20; ++s) crowd.step(step_s);
  EXPECT_GT(crowd.walkers().position[0].x, 3.5f);
}

TEST(NavMesh, PlacesLieOutsideOfClosedHouses) {
  TestGround ground;
  ground.rectangle({0, 0}, {40, 40});
  ground.block({10, 10}, {25, 25}, 9.0f);  // open inside, on the same ground
  const Result<NavMesh> mesh = NavMesh::create(ground);
  ASSERT_TRUE(mesh);
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const glm::vec3 p = mesh->place(random.uniform(), random.uniform(), random.uniform());
    ASSERT_FALSE(p.x > 10 && p.x < 25 && p.y > 10 && p.y < 25) << p.x << " " << p.y;
  }
  EXPECT_NEAR(mesh->area_m2(), 40.0f * 40.0f - 15.0f * 15.0f, 80.0f);
}

TEST(NavMesh, WithoutWalkableGroundSaysSo) {
  EXPECT_FALSE(NavMesh::create({}));
  TestGround wall;
  wall.quad({0, 0, 0}, {10, 0, 0}, {10, 0, 10}, {0, 0, 10});
  const Result<NavMesh> none = NavMesh::create(wall);
  ASSERT_FALSE(none);
  EXPECT_NE(to_string(none.errors()).find("nobody can walk"), std::string::npos);
  TestGround wide;
  wide.rectangle({0, 0}, {1e6f, 1});
  EXPECT_FALSE(NavMesh::create(wide));
  TestGround broken;
  broken.rectangle({0, 0}, {10, 10}, NAN);
  EXPECT_FALSE(NavMesh::create(broken));
}

TEST(Crowd, AGoalThatCannotBeReachedIsRefused) {
  TestGround ground;
  ground.rectangle({0, 0}, {5, 5});
  ground.rectangle({20, 0}, {25, 5});
  Crowd crowd = crowd_on(ground);
  const int island = crowd.add(Destination{{22, 2, 0}, {22, 2, 0}});
  EXPECT_FALSE(crowd.add({2, 2, 0}, island, 1.3f, radius_m));
  EXPECT_EQ(crowd.size(), 0u);
  EXPECT_FALSE(crowd.add({12, 2, 0}, -1, 1.3f, radius_m)) << "nor a place off the mesh";
}

}  // namespace
}  // namespace parvis::crowd
