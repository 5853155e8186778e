// The fifteen tests of the RiMEA guideline 3.0, as ../shared/data/crowd_tests describes them: geometry,
// people and bands come from there. Speeds on stairs (2, 3) are those along the slope.
#include <algorithm>
#include <array>
#include <cmath>

#include "base/plan_polygon.h"
#include "bench/crowd/test_place.h"

namespace parvis::bench {
namespace {

using Rules = crowd::SteeringRules;

/// Normal speeds within limits, of a group or of the default adults.
std::function<float()> speeds(const json& group, Random& random) {
  const bool is_default = group.contains("mean_m_s");
  const float mean = group.at(is_default ? "mean_m_s" : "mean"),
              sigma = group.at(is_default ? "sigma_m_s" : "sigma");
  const json& limits = group.at(is_default ? "limits_m_s" : "speed_m_s");
  const float low = limits.at(0), high = limits.at(1);
  return [=, &random] {
    float sum = -6.0f;
    for (int i = 0; i < 12; ++i) sum += random.uniform();
    return std::clamp(mean + sigma * sum, low, high);
  };
}
std::function<float()> adults(const json& all, Random& random) {
  return speeds(all.at("default_adults"), random);
}
std::function<float()> same(float speed) {
  return [speed] { return speed; };
}
int first_exit(glm::vec2) { return 0; }

bool is_within(float value, const json& band) {
  return value >= band.at(0).get<float>() && value <= band.at(1).get<float>();
}

/// People whose feet are in a polygon of a place.
int count_in(TestPlace& place, const std::vector<glm::vec2>& polygon) {
  return int(std::ranges::count_if(place.crowd().walkers().position,
                                   [&](glm::vec2 p) { return is_in_ring(polygon, p); }));
}

TestResult keeps_speed(const json& test, const json&, const Rules& rules) {  // 1
  const json& scene = test.at("scenes").at(0);
  TestPlace place(scene, rules);
  place.add({point_of(scene.at("start").at(0).at("point")), 0}, 0, scene.at("start").at(0).at("speed_m_s"));
  float from_s = -1.0f;
  const float end_s = place.run(100.0f, [&] {
    if (from_s < 0.0f && place.crowd().size() > 0 && place.crowd().walkers().position[0].x >= 0.0f)
      from_s = place.time_s();
  });
  const float time_s = end_s - from_s;
  return {is_within(time_s, test.at("expected").at("travel_time_s")), fmt::format("{:.1f} s", time_s)};
}

TestResult keeps_speed_on_stair(const json& test, const json&, const Rules& rules) {  // 2, 3
  const json& scene = test.at("scenes").at(0);
  const json& stair = scene.at("stairs").at(0);
  const bool up = stair.at("walked") == "up";
  TestPlace place(scene, rules);
  const float speed = scene.at("start").at(0).at("speed_m_s"), length = stair.at("length_along_slope_m");
  const float z = up ? stair.at("low_z") : stair.at("high_z");
  if (!place.add({point_of(scene.at("start").at(0).at("point")), z}, 0, speed)) return {false, "no way"};
  const float low_x = point_of(stair.at("low_edge").at(0)).x,
              high_x = point_of(stair.at("high_edge").at(0)).x;
  int steps = 0;
  place.run(100.0f, [&] {
    if (place.crowd().size() == 0) return;
    const float x = place.crowd().walkers().position[0].x;
    steps += x > low_x && x < high_x ? 1 : 0;
  });
  const float shown = length / (float(steps) * crowd_test_step_s);
  const float percent = test.at("expected").at("speed_on_stair_within_percent");
  return {std::abs(shown / speed - 1.0f) < 0.01f * percent,
          fmt::format("{:.3f} of {} m/s along the slope", shown, speed)};
}

TestResult fundamental_diagram(const json& test, const json&, const Rules& rules) {  // 4
  const std::vector<DensityPoint> points = speed_density(rules, 60.0f);
  float worst = 0.0f;
  std::string text;
  for (const DensityPoint& point : points) {
    worst = std::max(worst, point.error_percent());
    text += fmt::format("{:.2f} /m2: {:.2f} m/s; ", point.density, point.speed);
  }
  return {worst <= test.at("expected").at("tolerance_percent").get<float>(),
          fmt::format("{}worst {:.0f} %", text, worst)};
}

TestResult premovement(const json& test, const json&, const Rules& rules) {  // 5
  const json& start = test.at("scenes").at(0).at("start").at(0);
  TestPlace place(test.at("scenes").at(0), rules);
  Random random(5);
  for (const float waits_s : start.at("premovement_s").get<std::vector<float>>())
    place.fill(polygon_of(start.at("polygon")), 1, random, first_exit, same(start.at("speed_m_s")), waits_s);
  place.run(200.0f);
  float worst = 1e9f;
  if (place.walks().size() == 10) {
    worst = 0.0f;
    for (std::size_t i = 0; i < 10; ++i)
      worst = std::max(worst,
                       std::abs(place.walks()[i].set_off_s - start.at("premovement_s").at(i).get<float>()));
  }
  const float frames = test.at("expected").at("each_starts_at_its_time_within_frames");
  return {worst <= (frames + 0.01f) * crowd_test_step_s, fmt::format("within {:.2f} s", worst)};
}

TestResult round_corner(const json& test, const json&, const Rules& rules) {  // 6
  const json& scene = test.at("scenes").at(0);
  const json& start = scene.at("start").at(0);
  TestPlace place(scene, rules);
  Random random(6);
  const int people = place.fill(polygon_of(start.at("polygon")), start.at("people"), random, first_exit,
                                same(start.at("speed_m_s")));
  const std::vector<glm::vec2> forbidden = polygon_of(scene.at("forbidden"));
  int inside = 0;
  place.run(100.0f, [&] { inside += count_in(place, forbidden); });
  return {inside == 0 && people == 20 && place.left() == 20,
          fmt::format("{} inside the wall, {} arrived", inside, place.left())};
}

TestResult speeds_of_groups(const json& test, const json&, const Rules& rules) {  // 7
  const json& scene = test.at("scenes").at(0);
  TestPlace place(scene, rules);
  Random random(7);
  std::vector<std::string> group_of;
  for (const json& start : scene.at("start")) {
    const json& group = test.at("groups").at(start.at("group").get<std::string>());
    place.fill(polygon_of(start.at("polygon")), start.at("people"), random, first_exit, speeds(group, random),
               start.at("premovement_s"));
    group_of.resize(place.walks().size(), start.at("group"));
  }
  place.run(400.0f);
  int outside = 0;
  std::string text;
  for (std::size_t i = 0; i < place.walks().size(); ++i) {
    const TestWalk& walk = place.walks()[i];
    // Both times are those of steps: the walk took one less, or one more.
    const float way_m = place.exits()[0].a.x - walk.began.x, time_s = walk.left_s - walk.set_off_s;
    const json& band = test.at("groups").at(group_of[i]).at("speed_m_s");
    const float slowest = way_m / (time_s + crowd_test_step_s),
                fastest = way_m / (time_s - crowd_test_step_s);
    if (fastest >= band.at(0).get<float>() && slowest <= band.at(1).get<float>()) continue;
    ++outside;
    text += fmt::format(" ({} at {:.3f} m/s, asked for {:.3f})", group_of[i], way_m / time_s, walk.speed_m_s);
  }
  return {outside == 0 && place.left() == 200,
          fmt::format("{} of {} outside of their groups{}", outside, place.left(), text)};
}

/// The three floors of test 8, as rooms whose walls are 10 cm thick.
crowd::WalkingGround building(const json& scene, std::vector<std::pair<glm::vec3, glm::vec2>>& rooms) {
  constexpr float wall_m = 0.05f;
  crowd::WalkingGround ground;
  const auto floor = [&](glm::vec2 low, glm::vec2 high, float z) {
    add_floor(ground, {low, {high.x, low.y}, high, {low.x, high.y}}, z);
  };
  const float width = scene.at("room_grid").at("room_size_m").at(0);
  const auto [door_from, door_to] = line_of({{1, 0}, {2, 0}});
  for (const json& storey : scene.at("floors")) {
    const float z = storey.at("z");
    for (const json& row : storey.at("rows"))
      for (int r = 0; r < row.at("rooms").get<int>(); ++r) {
        const glm::vec2 low(width * float(r), row.at("y").at(0).get<float>()),
            high(low.x + width, row.at("y").at(1).get<float>());
        const float door_y = row.at("door_y");
        floor(low + wall_m, high - wall_m, z);
        floor({low.x + door_from.x, door_y - 2.0f * wall_m}, {low.x + door_to.x, door_y + 2.0f * wall_m}, z);
        rooms.emplace_back(glm::vec3(0.5f * (low + high), z), high - low);
      }
    for (const char* kind : {"corridors", "halls"})
      for (const json& polygon : storey.at(kind)) {
        const std::vector<glm::vec2> p = polygon_of(polygon);
        // Corridors end at their rooms' walls; halls join what they touch.
        const float inside = std::string(kind) == "corridors" ? wall_m : -0.001f;
        floor({p[0].x, p[0].y + inside}, {p[2].x, p[2].y - inside}, z);
        if (inside < 0.0f) floor({p[0].x, p[0].y - 2.0f * wall_m}, {p[2].x, p[2].y + 2.0f * wall_m}, z);
      }
  }
  for (const json& landing : scene.at("landings"))
    add_floor(ground, polygon_of(landing.at("polygon")), landing.at("z"));
  for (const json& stair : scene.at("stairs")) add_stair(ground, stair);
  return ground;
}

TestResult building_evacuated(const json& test, const json&, const Rules& rules) {  // 8
  const json& scene = test.at("scenes").at(0);
  std::vector<std::pair<glm::vec3, glm::vec2>> rooms;
  const crowd::WalkingGround ground = building(scene, rooms);
  std::string text;
  std::vector<float> times;
  int asked = 0, least = 1 << 20;
  for (const float speed : test.at("vary").at("speed_m_s_all_equal").get<std::vector<float>>()) {
    TestPlace place(ground, scene, rules);
    asked = 0;
    for (const auto& [middle, size] : rooms)
      for (int i = 0; i < 4; ++i, ++asked)
        place.add(middle + glm::vec3(0.4f * float(i % 2) - 0.2f, 0.6f * float(i / 2) - 0.3f, 0.0f), 0, speed);
    times.push_back(place.run(900.0f));
    least = std::min(least, place.left());
    text += fmt::format("{} m/s: {:.0f} s; ", speed, times.back());
    for (std::size_t i = 0; i < place.crowd().size(); ++i) {
      const glm::vec2 here = place.crowd().walkers().position[i];
      text += fmt::format("one stays at {:.1f} {:.1f} {:.1f}; ", here.x, here.y,
                          place.crowd().walkers().height_m[i]);
    }
    if (int(place.walks().size()) < asked)
      text += fmt::format("{} find no way; ", asked - int(place.walks().size()));
  }
  return {least == asked && std::ranges::is_sorted(times, std::greater()),
          fmt::format("{}{} of {} leave", text, least, asked)};
}

TestResult doors(const json& test, const json& all, const Rules& rules) {  // 9
  std::vector<float> times;
  for (const json& scene : test.at("scenes")) {
    // The second scene's people are those of the first.
    const json& start = test.at("scenes").at(0).at("start").at(0);
    TestPlace place(scene, rules);
    Random random(9);
    const int people = place.fill(
        polygon_of(start.at("polygon")), start.at("people"), random,
        [&](glm::vec2 p) { return place.nearest_exit(p); }, adults(all, random));
    times.push_back(place.run(900.0f));
    if (people != 1000 || place.left() != 1000)
      return {false, fmt::format("{} of {} leave", place.left(), people)};
  }
  const float ratio = times[1] / times[0];
  return {is_within(ratio, test.at("expected").at("time_ratio_two_to_four")),
          fmt::format("{:.0f} s and {:.0f} s, ratio {:.2f}", times[0], times[1], ratio)};
}

TestResult assigned_routes(const json& test, const json&, const Rules& rules) {  // 10
  const json& scene = test.at("scenes").at(0);
  constexpr float wall_m = 0.05f;
  crowd::WalkingGround ground;
  const auto rectangle = [&](const json& polygon, glm::vec2 inside) {
    const std::vector<glm::vec2> p = polygon_of(polygon);
    const glm::vec2 low = p[0] + inside, high = p[2] - inside;
    add_floor(ground, {low, {high.x, low.y}, high, {low.x, high.y}});
  };
  rectangle(scene.at("corridor"), {0.0f, wall_m}), rectangle(scene.at("passage"), {wall_m, -2.0f * wall_m});
  for (const json& room : scene.at("rooms")) {
    rectangle(room.at("polygon"), glm::vec2(wall_m));
    const auto [a, b] = line_of(room.at("door"));
    const float half = 2.0f * wall_m;
    add_floor(ground, {{a.x, a.y - half}, {b.x, a.y - half}, {b.x, b.y + half}, {a.x, b.y + half}});
  }
  TestPlace place(ground, scene, rules);
  std::map<std::string, int> expected;
  for (const json& room : scene.at("rooms")) {
    const std::vector<glm::vec2> p = polygon_of(room.at("polygon"));
    const int exit = room.at("exit") == place.exits()[0].id ? 0 : 1;
    for (int i = 0; i < room.at("people").get<int>(); ++i)
      place.add({0.5f * (p[0] + p[2]) + glm::vec2(0.0f, 0.6f * float(i)), 0.0f}, exit, 1.33f);
  }
  place.run(120.0f);
  std::array<int, 2> by{};
  for (const TestWalk& walk : place.walks())
    if (walk.left_s >= 0.0f) ++by[std::size_t(walk.exit)];
  const json& wanted = test.at("expected").at("people_by_exit");
  return {by[0] == wanted.at("main").get<int>() && by[1] == wanted.at("secondary").get<int>(),
          fmt::format("main {}, secondary {}", by[0], by[1])};
}

TestResult choice_of_exit(const json& test, const json& all, const Rules& rules) {  // 11
  const json& scene = test.at("scenes").at(0);
  TestPlace place(scene, rules);
  Random random(11);
  const json& start = scene.at("start").at(0);
  const int people = place.fill(
      polygon_of(start.at("polygon")), start.at("people"), random,
      [&](glm::vec2 p) { return place.nearest_exit(p); }, adults(all, random));
  place.chooses_exits = true;
  int jam = 0;
  const std::vector<glm::vec2> before{{19.5f, 17.0f}, {23.5f, 17.0f}, {23.5f, 20.0f}, {19.5f, 20.0f}};
  place.run(900.0f, [&] { jam = std::max(jam, count_in(place, before)); });
  std::array<int, 2> by{};
  for (const TestWalk& walk : place.walks())
    if (walk.left_s >= 0.0f) ++by[std::size_t(walk.exit)];
  const float density = float(jam) / 12.0f;
  return {people == 1000 && place.left() == 1000 && by[0] > by[1] && by[1] >= 1 && density > 2.0f,
          fmt::format("{} by the near door, {} by the far one, {:.1f} per m2 before the near one", by[0],
                      by[1], density)};
}

TestResult bottleneck(const json& test, const json& all, const Rules& rules) {  // 12
  const json& scene = test.at("scenes").at(0);
  TestPlace place(scene, rules);
  Random random(12);
  const json& start = scene.at("start").at(0);
  const int people = place.fill(polygon_of(start.at("polygon")), start.at("people"), random, first_exit,
                                adults(all, random));
  float first_corridor = -1, last_corridor = 0, first_exit_s = -1, last_exit_s = 0, jam_1 = 0, jam_2 = 0;
  std::vector<float> crossed(place.walks().size(), -1.0f), out(place.walks().size(), -1.0f);
  const std::vector<glm::vec2> before_corridor{{7, 3.5f}, {10, 3.5f}, {10, 6.5f}, {7, 6.5f}},
      before_exit{{22, 3.5f}, {25, 3.5f}, {25, 6.5f}, {22, 6.5f}};
  place.run(600.0f, [&] {
    for (std::size_t i = 0; i < place.crowd().size(); ++i) {
      const std::size_t n = place.crowd().people()[i].number;
      const float x = place.crowd().walkers().position[i].x;
      if (x > 15.0f && crossed[n] < 0.0f) crossed[n] = last_corridor = place.time_s();
      if (x > 24.0f && out[n] < 0.0f) out[n] = last_exit_s = place.time_s();
      if (crossed[n] >= 0.0f && first_corridor < 0.0f) first_corridor = place.time_s();
      if (out[n] >= 0.0f && first_exit_s < 0.0f) first_exit_s = place.time_s();
    }
    jam_1 = std::max(jam_1, float(count_in(place, before_corridor)) / 9.0f);
    jam_2 = std::max(jam_2, float(count_in(place, before_exit)) / 9.0f);
  });
  const float corridor = float(people) / (last_corridor - first_corridor),
              exit = float(people) / (last_exit_s - first_exit_s);
  const float margin = test.at("expected").at("flow_end_of_corridor_minus_flow_before_exit_at_least_per_s");
  return {
      place.left() == people && corridor - exit >= margin && jam_1 > 1.5f && jam_2 < 1.0f,
      fmt::format(
          "{:.2f} per s out of the corridor, {:.2f} before the exit; {:.1f} and {:.1f} per m2 before them",
          corridor, exit, jam_1, jam_2)};
}

TestResult foot_of_stair(const json& test, const json& all, const Rules& rules) {  // 13
  const json& scene = test.at("scenes").at(0);
  TestPlace place(scene, rules);
  Random random(13);
  const json& start = scene.at("start").at(0);
  const int people = place.fill(polygon_of(start.at("polygon")), start.at("people"), random, first_exit,
                                adults(all, random));
  float jam_room = 0, jam_stair = 0;
  std::vector<float> corridor(place.walks().size(), -1.0f), stair(place.walks().size(), -1.0f);
  const std::vector<glm::vec2> before_corridor{{3, 2.5f}, {5, 2.5f}, {5, 5.5f}, {3, 5.5f}},
      before_stair{{15, 3}, {17, 3}, {17, 5}, {15, 5}};
  place.run(600.0f, [&] {
    for (std::size_t i = 0; i < place.crowd().size(); ++i) {
      const std::size_t n = place.crowd().people()[i].number;
      const float x = place.crowd().walkers().position[i].x;
      if (x > 5.0f && corridor[n] < 0.0f) corridor[n] = place.time_s();
      if (x > 17.0f && stair[n] < 0.0f) stair[n] = place.time_s();
    }
    jam_room = std::max(jam_room, float(count_in(place, before_corridor)) / 6.0f);
    jam_stair = std::max(jam_stair, float(count_in(place, before_stair)) / 4.0f);
  });
  // Flows of the first half, while both are pressed.
  const auto flow = [&](std::vector<float> times) {
    std::ranges::sort(times);
    const std::size_t half = times.size() / 2;
    return times.front() < 0.0f ? 0.0f : float(half) / (times[half] - times[0]);
  };
  const float in = flow(corridor), up = flow(stair);
  return {
      place.left() == people && up < in && jam_room > 1.5f && jam_stair > 1.5f,
      fmt::format("{:.2f} per s into the corridor, {:.2f} up the stair; {:.1f} and {:.1f} per m2 before them",
                  in, up, jam_room, jam_stair)};
}

TestResult two_routes(const json& test, const json&, const Rules& rules) {  // 14
  const json& scene = test.at("scenes").at(0);
  TestPlace place(scene, rules);
  Random random(14);
  const json& start = scene.at("start").at(0);
  const int people = place.fill(polygon_of(start.at("polygon")), start.at("people"), random, first_exit,
                                same(start.at("speed_m_s")));
  std::vector<bool> is_below(place.walks().size(), false);
  place.run(400.0f, [&] {
    for (std::size_t i = 0; i < place.crowd().size(); ++i)
      if (place.crowd().walkers().height_m[i] < -3.0f) is_below[place.crowd().people()[i].number] = true;
  });
  return {place.left() == people && people == 100,
          fmt::format("{} by the stairs, {} by the level way", std::ranges::count(is_below, true),
                      std::ranges::count(is_below, false))};
}

TestResult crowd_round_corner(const json& test, const json& all, const Rules& rules) {  // 15
  std::map<std::string, float> last;
  for (const json& scene : test.at("scenes")) {
    TestPlace place(scene, rules);
    Random random(15);
    const json& start = scene.at("start").at(0);
    const int people = place.fill(polygon_of(start.at("polygon")), start.at("people"), random, first_exit,
                                  adults(all, random));
    last[scene.at("name")] = place.run(600.0f);
    if (people != 500 || place.left() != 500)
      return {false, fmt::format("{} of {} arrive", place.left(), people)};
  }
  return {last["short"] < last["corner"] && last["corner"] < last["long"],
          fmt::format("short {:.1f} s, corner {:.1f} s, long {:.1f} s", last["short"], last["corner"],
                      last["long"])};
}

}  // namespace

std::map<int, TestResult> run_rimea(const json& tests, const Rules& rules) {
  using Test = TestResult (*)(const json& test, const json& all, const Rules& rules);
  constexpr std::array<Test, 15> functions{keeps_speed,         keeps_speed_on_stair, keeps_speed_on_stair,
                                           fundamental_diagram, premovement,          round_corner,
                                           speeds_of_groups,    building_evacuated,   doors,
                                           assigned_routes,     choice_of_exit,       bottleneck,
                                           foot_of_stair,       two_routes,           crowd_round_corner};
  std::map<int, TestResult> results;
  for (const json& test : tests.at("tests")) {
    const int id = test.at("id");
    results[id] = functions[std::size_t(id - 1)](test, tests, rules);
  }
  return results;
}

}  // namespace parvis::bench
