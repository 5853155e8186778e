// The places of the RiMEA tests (../shared/data/crowd_tests): ground, exits and people from their JSON,
// walked in steps of a tenth of a second.
#pragma once

#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/random.h"
#include "life/crowd/crowd.h"

namespace parvis::bench {

using nlohmann::json;

inline constexpr float crowd_test_step_s = 0.1f;

glm::vec2 point_of(const json& point);
/// Ends of a line.
std::pair<glm::vec2, glm::vec2> line_of(const json& line);
/// The corners of a polygon.
std::vector<glm::vec2> polygon_of(const json& polygon);

/// Adds the floor of a polygon with sides along the axes.
void add_floor(crowd::WalkingGround& ground, const std::vector<glm::vec2>& polygon, float z = 0.0f);
/// Adds a slope between two edges at their heights.
void add_stair(crowd::WalkingGround& ground, const json& stair);

/// Where people leave.
struct TestExit {
  std::string id;
  glm::vec2 a, b, outward;
  float z = 0.0f;
  int destination = -1;
};

/// The walk of one person.
struct TestWalk {
  glm::vec2 began{0.0f};
  float set_off_s = -1.0f;  ///< has moved by 5 cm
  float left_s = -1.0f;     ///< past an exit's line; negative: not yet
  int exit = -1;
  float speed_m_s = 0.0f;  ///< that was given
};

/// A running test.
class TestPlace {
 public:
  /// Floors, stairs and exits of a scene. Exits go on for a while beyond their lines.
  TestPlace(const json& scene, const crowd::SteeringRules& rules);
  /// The same on ground that is made elsewhere, with the exits of the scene.
  TestPlace(crowd::WalkingGround ground, const json& scene, const crowd::SteeringRules& rules);

  /// Adds somebody who walks to an exit; false where there is no place or no way.
  bool add(glm::vec3 where, int exit, float speed_m_s, float waits_s = 0.0f);
  /// Adds people at random places of a polygon, bodies apart; returns how many.
  int fill(const std::vector<glm::vec2>& polygon, int people, Random& random,
           const std::function<int(glm::vec2)>& exit_of, const std::function<float()>& speed,
           float waits_s = 0.0f);
  /// A step; who has left is removed.
  void step();
  /// Steps until all have left or `limit_s` has passed; returns the time of the last who left.
  float run(
      float limit_s, const std::function<void()>& look = [] {});

  /// Everybody looks every 3 s by which exit they would be out first.
  bool chooses_exits = false;

  crowd::Crowd& crowd() { return crowd_; }
  const std::vector<TestExit>& exits() const { return exits_; }
  const std::vector<TestWalk>& walks() const { return walks_; }  ///< by PersonOnTheWay::number
  float time_s() const { return time_s_; }
  int left() const;
  /// The exit nearest to a place.
  int nearest_exit(glm::vec2 place) const;

 private:
  void choose_exits();
  static crowd::WalkingGround ground_of(const json& scene);
  static std::vector<TestExit> exits_of(const json& scene, crowd::WalkingGround& ground);

  std::vector<TestExit> exits_;
  crowd::Crowd crowd_;
  std::vector<TestWalk> walks_;
  float time_s_ = 0.0f;
};

/// The outcome of a test.
struct TestResult {
  bool has_passed = false;
  std::string text;
};

/// Runs the fifteen tests, by their ids.
std::map<int, TestResult> run_rimea(const json& tests, const crowd::SteeringRules& rules);

/// Mean of speeds over Weidmann's curve, in percent: see speed_density.cpp.
struct DensityPoint {
  float asked = 0.0f, density = 0.0f, speed = 0.0f;
  float error_percent() const;
};
/// One way through a periodic corridor of 26 x 2 m, after 10 s for `seconds`; density by Voronoi cells in the
/// middle 2 x 2 m.
std::vector<DensityPoint> speed_density(const crowd::SteeringRules& rules, float seconds);

}  // namespace parvis::bench
