#include "bench/crowd/test_place.h"

#include <algorithm>
#include <cmath>

#include "base/plan_polygon.h"
#include "bench/bench.h"

namespace parvis::bench {
namespace {

constexpr float body_m = 0.19f;   // radius
constexpr float beyond_m = 1.2f;  // ground beyond an exit's line
constexpr float apart_m = 0.38f;  // people who begin
// Stairs of the tests rise as far as they go.

void add_quad(crowd::WalkingGround& ground, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
  for (const glm::vec3 p : {a, b, c, a, c, d}) ground.corners.push_back(p);
  ground.kinds.insert(ground.kinds.end(), 2, crowd::GroundKind::floor);
}

crowd::Crowd crowd_on(const crowd::WalkingGround& ground, const crowd::SteeringRules& rules) {
  return crowd::Crowd(
      must(crowd::NavMesh::create(ground, {.cell_m = 0.05f, .body_radius_m = 0.15f, .max_slope_deg = 50.0f})),
      rules);
}

bool is_on(const crowd::WalkingGround& ground, glm::vec2 p) {
  for (std::size_t t = 0; 3 * t + 2 < ground.corners.size(); ++t)
    if (is_in_triangle(std::span(&ground.corners[3 * t], 3), p)) return true;
  return false;
}

}  // namespace

glm::vec2 point_of(const json& point) { return {point.at(0).get<float>(), point.at(1).get<float>()}; }
std::pair<glm::vec2, glm::vec2> line_of(const json& line) {
  return {point_of(line.at(0)), point_of(line.at(1))};
}
std::vector<glm::vec2> polygon_of(const json& polygon) {
  std::vector<glm::vec2> points;
  for (const json& point : polygon) points.push_back(point_of(point));
  return points;
}

void add_floor(crowd::WalkingGround& ground, const std::vector<glm::vec2>& polygon, float z) {
  std::vector<float> levels;
  for (const glm::vec2 p : polygon) levels.push_back(p.y);
  std::ranges::sort(levels);
  levels.erase(std::ranges::unique(levels).begin(), levels.end());
  for (std::size_t i = 0; i + 1 < levels.size(); ++i) {
    const float low = levels[i], high = levels[i + 1];
    const std::vector<float> x = crossings_of_line(std::span(&polygon, 1), 0.5f * (low + high));
    for (std::size_t k = 0; k + 1 < x.size(); k += 2)
      add_quad(ground, {x[k], low, z}, {x[k + 1], low, z}, {x[k + 1], high, z}, {x[k], high, z});
  }
}

void add_stair(crowd::WalkingGround& ground, const json& stair) {
  const auto [a, b] = line_of(stair.at("low_edge"));
  const auto [d, c] = line_of(stair.at("high_edge"));
  const float low = stair.at("low_z"), high = stair.at("high_z");
  add_quad(ground, {a, low}, {b, low}, {c, high}, {d, high});
}

crowd::WalkingGround TestPlace::ground_of(const json& scene) {
  crowd::WalkingGround ground;
  // Floors beyond the upper edge of a stair lie at its height.
  const auto height_of = [&](const std::vector<glm::vec2>& polygon) {
    for (const json& stair : scene.value("stairs", json::array())) {
      const auto [a, b] = line_of(stair.at("high_edge"));
      const glm::vec2 middle = 0.5f * (a + b);
      for (std::size_t i = 0; i < polygon.size(); ++i)
        if (glm::distance(crowd::nearest_on_segment(polygon[i], polygon[(i + 1) % polygon.size()], middle),
                          middle) < 0.01f)
          return stair.at("high_z").get<float>();
    }
    return 0.0f;
  };
  for (const json& polygon : scene.at("walkable"))
    add_floor(ground, polygon_of(polygon), height_of(polygon_of(polygon)));
  for (const json& floor : scene.value("floors", json::array()))
    for (const json& polygon : floor.at("walkable")) add_floor(ground, polygon_of(polygon), floor.at("z"));
  for (const json& stair : scene.value("stairs", json::array())) add_stair(ground, stair);
  return ground;
}

std::vector<TestExit> TestPlace::exits_of(const json& scene, crowd::WalkingGround& ground) {
  std::vector<TestExit> exits;
  const crowd::WalkingGround inside = ground;
  for (const json& exit : scene.at("exits")) {
    const auto [a, b] = line_of(exit.at("line"));
    const glm::vec2 along = glm::normalize(b - a), across(-along.y, along.x), middle = 0.5f * (a + b);
    const glm::vec2 outward = is_on(inside, middle + 0.2f * across) ? -across : across;
    float height = exit.value("z", 0.0f);
    for (const json& stair : scene.value("stairs", json::array()))  // beyond a stair that is walked up
      if (!exit.contains("z") && stair.value("walked", "") == "up") height = stair.at("high_z");
    const glm::vec2 overlap = -0.02f * outward;
    add_quad(ground, {a + overlap, height}, {b + overlap, height}, {b + beyond_m * outward, height},
             {a + beyond_m * outward, height});
    exits.push_back({exit.at("id"), a, b, outward, height});
  }
  return exits;
}

TestPlace::TestPlace(const json& scene, const crowd::SteeringRules& rules)
    : TestPlace(ground_of(scene), scene, rules) {}

TestPlace::TestPlace(crowd::WalkingGround ground, const json& scene, const crowd::SteeringRules& rules)
    : exits_(exits_of(scene, ground)), crowd_(crowd_on(ground, rules)) {
  for (TestExit& exit : exits_) {
    const glm::vec2 out = 0.7f * exit.outward;
    exit.destination = crowd_.add(crowd::Destination{{exit.a + out, exit.z}, {exit.b + out, exit.z}, 0.3f});
  }
}

bool TestPlace::add(glm::vec3 where, int exit, float speed_m_s, float waits_s) {
  if (!crowd_.add(where, exits_[std::size_t(exit)].destination, speed_m_s, body_m, waits_s)) return false;
  walks_.resize(crowd_.people().back().number + 1);
  TestWalk& walk = walks_.back();
  walk.began = where, walk.exit = exit, walk.speed_m_s = speed_m_s;
  return true;
}

int TestPlace::fill(const std::vector<glm::vec2>& polygon, int people, Random& random,
                    const std::function<int(glm::vec2)>& exit_of, const std::function<float()>& speed,
                    float waits_s) {
  glm::vec2 low = polygon[0], high = low;
  for (const glm::vec2 p : polygon) low = glm::min(low, p), high = glm::max(high, p);
  low += 0.16f, high -= 0.16f;
  std::vector<glm::vec2> taken;
  float apart = apart_m;
  for (int tries = 0; int(taken.size()) < people && tries < 400'000; ++tries) {
    if (tries % 50'000 == 49'999) apart *= 0.9f;  // crowded starts
    const glm::vec2 p(random.uniform(low.x, high.x), random.uniform(low.y, high.y));
    const auto is_near = [&](glm::vec2 other) { return glm::distance(p, other) < apart; };
    if (std::ranges::none_of(taken, is_near) && add({p, 0.0f}, exit_of(p), speed(), waits_s))
      taken.push_back(p);
  }
  return int(taken.size());
}

void TestPlace::choose_exits() {
  constexpr int steps_between = 30;
  const auto now = std::uint32_t(time_s_ / crowd_test_step_s + 0.5f);
  std::vector<int> all;
  for (const TestExit& exit : exits_) all.push_back(exit.destination);
  for (std::size_t i = 0; i < crowd_.size(); ++i) {
    const crowd::PersonOnTheWay& person = crowd_.people()[i];
    if ((person.number + now) % steps_between != 0) continue;
    const int best = crowd_.quickest(i, all);
    if (best == person.destination || !crowd_.send(i, best)) continue;
    walks_[person.number].exit = int(std::ranges::find(all, best) - all.begin());
  }
}

void TestPlace::step() {
  if (chooses_exits) choose_exits();
  crowd_.step(crowd_test_step_s);
  time_s_ += crowd_test_step_s;
  for (std::size_t i = crowd_.size(); i-- > 0;) {
    TestWalk& walk = walks_[crowd_.people()[i].number];
    const glm::vec2 here = crowd_.walkers().position[i];
    if (walk.set_off_s < 0.0f && glm::distance(here, walk.began) > 0.05f) walk.set_off_s = time_s_;
    const TestExit& exit = exits_[std::size_t(walk.exit)];
    if (walk.left_s < 0.0f && glm::dot(here - exit.a, exit.outward) > 0.0f) walk.left_s = time_s_;
    if (!crowd_.people()[i].has_arrived) continue;
    if (walk.left_s < 0.0f) walk.left_s = time_s_;
    crowd_.remove(i);
  }
}

float TestPlace::run(float limit_s, const std::function<void()>& look) {
  while (crowd_.size() > 0 && time_s_ < limit_s) step(), look();
  float last = 0.0f;
  for (const TestWalk& walk : walks_) last = std::max(last, walk.left_s);
  return last;
}

int TestPlace::left() const {
  return int(std::ranges::count_if(walks_, [](const TestWalk& walk) { return walk.left_s >= 0.0f; }));
}

int TestPlace::nearest_exit(glm::vec2 place) const {
  const auto far = [&](const TestExit& exit) {
    return glm::distance(crowd::nearest_on_segment(exit.a, exit.b, place), place);
  };
  return int(std::ranges::min_element(exits_, {}, far) - exits_.begin());
}

}  // namespace parvis::bench
