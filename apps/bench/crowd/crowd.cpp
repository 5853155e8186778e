// What the bench "crowd" measures: RiMEA's tests, speeds over densities, recorded people, the time of a step,
// frames with people, and the scene after a jump in time.
#include <cmath>
#include <fstream>
#include <numeric>

#include "base/content_hash.h"
#include "base/random.h"
#include "base/test_data.h"
#include "bench/crowd/test_place.h"
#include "bench/parts.h"
#include "life/crowd/crowd_process.h"

namespace parvis::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::array<int, 7> quick_tests{1, 2, 3, 5, 6, 7, 10};

/// Rules with which people neither keep a distance nor clear each other in time: a control.
crowd::SteeringRules heedless() {
  crowd::SteeringRules rules;
  rules.headway_s = 0.01f, rules.horizon_s = 0.05f, rules.wall_horizon_s = 0.01f;
  return rules;
}

/// Rules with which people stand far from each other: a control of ways.
crowd::SteeringRules timid() {
  crowd::SteeringRules rules;
  rules.headway_s = 4.0f, rules.headway_width = 3.0f;
  return rules;
}

int passed(const std::map<int, TestResult>& results) {
  return int(std::ranges::count_if(results, [](const auto& result) { return result.second.has_passed; }));
}

double worst_error(const std::vector<DensityPoint>& points) {
  double worst = 0.0;
  for (const DensityPoint& point : points) worst = std::max(worst, double(point.error_percent()));
  return worst;
}

/// So many people on level ground, one for each 3 m2, who walk to random places of it.
std::vector<double> step_times(int people, int steps) {
  const float side_m = std::sqrt(3.0f * float(people));
  crowd::Walkers walkers;
  crowd::Steering steering;
  Random random(1);
  for (int i = 0; i < people; ++i) {
    walkers.add({random.uniform(0, side_m), random.uniform(0, side_m)}, 0.0f, 0.21f,
                random.uniform(1.0f, 1.6f));
    const float angle = random.uniform(-3.1416f, 3.1416f);
    walkers.aim.back() = {std::cos(angle), std::sin(angle)};
  }
  const crowd::Walls walls({}, 1.2f);
  std::vector<double> times;
  for (int s = 0; s < steps; ++s) {
    const double ms = milliseconds([&] { steering.step(walkers, walls, {}, crowd_test_step_s); });
    if (s >= steps / 4) times.push_back(ms);
  }
  return times;
}

/// Recorded people: places by frame of 0.4 s.
struct Recording {
  std::map<int, std::vector<std::pair<int, glm::vec2>>> frames;  ///< people by number, in each frame
  std::map<int, std::map<int, glm::vec2>> ways;                  ///< of each person, by frame
};

Recording recording_of(const fs::path& file, int frames_per_step) {
  Recording result;
  std::ifstream stream(file);
  double frame = 0, number = 0, x = 0, up = 0, y = 0, vx = 0, vup = 0, vy = 0;
  while (stream >> frame >> number >> x >> up >> y >> vx >> vup >> vy) {
    const int step = int(std::lround(frame / frames_per_step));
    result.frames[step].emplace_back(int(number), glm::vec2(x, y));
    result.ways[int(number)][step] = {x, y};
  }
  return result;
}

/// Mean distance from the recorded places over 12 steps of 0.4 s, of our people and of a straight line;
/// `steps` from one start to the next.
std::pair<double, double> displacement_errors(const Recording& recording, int stride,
                                              const crowd::SteeringRules& rules) {
  constexpr int ahead = 12, per_step = 4;
  double ours = 0.0, straight = 0.0;
  long count = 0;
  for (const auto& [number, way] : recording.ways)
    for (const auto& [first, start] : way) {
      if (first % stride != 0 || !way.contains(first + ahead) || !way.contains(first - 1)) continue;
      const glm::vec2 goal = way.at(first + ahead), all = goal - start;
      const float length = glm::length(all);
      if (length < 0.5f) continue;
      crowd::Steering steering(rules);
      glm::vec2 here = start, velocity = (start - way.at(first - 1)) / 0.4f;
      for (int s = 0; s < ahead; ++s) {
        for (int part = 0; part < per_step; ++part) {
          crowd::Walkers walkers;
          const float left_s = 0.4f * float(ahead - s) - 0.1f * float(part);
          walkers.add(here, 0.0f, 0.19f, std::max(glm::distance(here, goal) / left_s, 0.05f));
          walkers.velocity[0] = velocity, walkers.aim[0] = glm::normalize(goal - here + glm::vec2(1e-5f));
          if (const auto now = recording.frames.find(first + s); now != recording.frames.end())
            for (const auto& [other, place] : now->second) {
              const std::map<int, glm::vec2>& of_other = recording.ways.at(other);
              const auto next = of_other.find(first + s + 1);
              if (other == number || next == of_other.end()) continue;
              const glm::vec2 goes = next->second - place;
              const std::size_t i =
                  walkers.add(place + 0.25f * float(part) * goes, 0.0f, 0.19f, glm::length(goes) / 0.4f);
              walkers.velocity[i] = goes / 0.4f;
              if (glm::length(goes) > 0.02f) walkers.aim[i] = glm::normalize(goes);
            }
          steering.step(walkers, crowd::Walls({}, 1.2f), {}, 0.1f);
          here = walkers.position[0], velocity = walkers.velocity[0];
        }
        const glm::vec2 truth = way.contains(first + s + 1) ? way.at(first + s + 1) : glm::vec2(0.0f);
        if (!way.contains(first + s + 1)) continue;
        ours += glm::distance(here, truth);
        straight += glm::distance(start + all * (float(s + 1) / float(ahead)), truth);
        ++count;
      }
    }
  return {ours / double(count), straight / double(count)};
}

/// A script beside that of the city, with people about its main crossing.
stage::Simulation city_with_people(const BenchSetup& setup, int people, float radius_m = 90.0f) {
  const fs::path script = setup.city() / fmt::format("bench_{}_people.xp", people);
  std::ofstream(script) << "include(file=\"paper.xp\")\n"
                        << (people > 0
                                ? fmt::format("crowd(people={}, seed=3, centre=\"-74 72 0\", radius={})\n",
                                              people, radius_m)
                                : "");
  return setup.simulation(script);
}

/// Pixels of the street that differ from the same moment without people.
double people_pixels(stage::Stage& stage, int width, int height) {
  const Camera camera = must(stage.camera("street"));
  const auto picture = [&](bool has_people) {
    stage.simulation().scene.data<crowd::CrowdDemand>().is_visible = has_people;
    stage.simulation().advance(0.0);
    stage.draw(camera, width, height);
    return stage.picture();
  };
  const Image8 with = picture(true), without = picture(false);
  constexpr int visible = 6;  // of 255
  int count = 0;
  for (std::size_t i = 0; i < with.pixels.size(); i += std::size_t(with.channels))
    count += std::abs(int(with.pixels[i]) - int(without.pixels[i])) > visible ? 1 : 0;
  return double(count);
}

std::uint64_t places_of(const scene::Scene& scene) {
  ContentHash hash;
  for (const scene::Object& object : scene.objects) {
    hash.add(object.world_from_model), hash.add(object.is_visible);
    for (const Mesh& mesh : object.deformed_meshes) hash.add(mesh.positions);
  }
  return hash.value();
}

}  // namespace

void measure_walking(const BenchSetup& setup, Report& report) {
  const auto folder = shared_data("crowd_tests", fs::current_path());
  if (!folder) {
    report.skip("rimea_tests_passed", "the shared tests are absent");
  } else {
    std::ifstream stream(*folder / "rimea.json");
    json tests = json::parse(stream);
    const std::map<int, TestResult> results = run_rimea(tests, {});
    for (const auto& [id, result] : results)
      report.note(fmt::format("RiMEA {}: {}: {}", id, result.has_passed ? "passed" : "failed", result.text));
    report.add("rimea_tests_passed", passed(results));
    json few = tests;
    few["tests"] = json::array();
    for (const json& test : tests["tests"])
      if (std::ranges::count(quick_tests, test["id"].get<int>()) > 0 || test["id"] == 4)
        few["tests"].push_back(test);
    const std::map<int, TestResult> broken = run_rimea(few, heedless());
    std::map<int, TestResult> mixed = results;  // the others as they are
    for (const auto& [id, result] : broken) mixed[id] = result;
    report.add("rimea_tests_passed_heedless", passed(mixed));
  }
  const float seconds = setup.is_quick ? 30.0f : 120.0f;
  const std::vector<DensityPoint> points = speed_density({}, seconds);
  for (const DensityPoint& point : points)
    report.note(fmt::format("{:.2f} people per m2 walk at {:.3f} m/s ({:.1f} % off)", point.density,
                            point.speed, point.error_percent()));
  report.add("speed_density_error_percent", worst_error(points));
  report.add("speed_density_error_percent_heedless", worst_error(speed_density(heedless(), 20.0f)));
  const int steps = setup.is_quick ? 40 : 120;
  report.add("people_step_ms_10000", median(step_times(10'000, steps)));
  report.add("people_step_ms_10000_of_40000", median(step_times(40'000, steps / 4)));
}

void measure_recorded_people(const BenchSetup& setup, Report& report) {
  const auto folder = shared_data("crowd", fs::current_path());
  if (!folder) {
    report.skip("trajectory_ade_m", "the shared recordings are absent");
    return;
  }
  double ours = 0.0, straight = 0.0, timidly = 0.0, sets = 0.0;
  for (const auto& [name, frames] :
       {std::pair("ETH/seq_eth", 6), {"ETH/seq_hotel", 10}, {"UCY/zara01", 10}, {"UCY/students03", 10}}) {
    const fs::path file = *folder / name / "obsmat.txt";
    if (!fs::exists(file)) continue;
    const Recording recording = recording_of(file, frames);
    const int stride = setup.is_quick ? 12 : 4;
    const auto [own, line] = displacement_errors(recording, stride, {});
    report.note(fmt::format("{}: {:.3f} m, straight {:.3f} m", name, own, line));
    sets += 1.0, ours += own, straight += line,
        timidly += displacement_errors(recording, stride, timid()).first;
  }
  report.add("trajectory_ade_m", ours / sets, maximum(straight / sets),
             {{"trajectory_ade_m_timid", timidly / sets}});
}

void measure_shown_people(const BenchSetup& setup, Report& report) {
  constexpr int width = 1280, height = 720;
  const auto bare = stage_of(city_with_people(setup, 0)), some = stage_of(city_with_people(setup, 200)),
             many = stage_of(city_with_people(setup, 4000));
  std::vector<double> without, with, crowded;
  const auto frame = [&](stage::Stage& stage) {
    stage.simulation().advance(1.0 / 60.0);
    const Camera camera = must(stage.camera("street"));
    return milliseconds([&] { stage.draw(camera, width, height), glFinish(); });
  };
  for (int i = 0; i < (setup.is_quick ? 8 : 30); ++i) {
    const double a = frame(*bare), b = frame(*some), c = i < 8 ? frame(*many) : 0.0;
    if (i < 2) continue;
    without.push_back(a), with.push_back(b);
    if (i < 8) crowded.push_back(c);
  }
  const auto throng = stage_of(city_with_people(setup, 10'000, 400.0f));
  std::vector<double> thronged;
  for (int i = 0; i < 4; ++i)
    if (const double ms = frame(*throng); i > 0) thronged.push_back(ms);
  report.add("people_pixels_10000", people_pixels(*throng, width, height));
  report.add("people_pixels_200", people_pixels(*some, width, height));
  report.add("people_draw_ms_10000", median(thronged).value - median(without).value);
  report.add("frame_ms_without_people", median(without));
  report.add("frame_ratio_with_200_people", ratio_in_turn(with, without));
  report.add("frame_ratio_with_4000_people", ratio(median(crowded), median(without)));
}

void measure_jumps(const BenchSetup& setup, Report& report) {
  const auto after = [&](const std::vector<double>& jumps) {
    stage::Simulation simulation = city_with_people(setup, 60);
    for (const double seconds : jumps) simulation.advance(seconds);
    simulation.settle();
    return places_of(simulation.scene);
  };
  const int seconds = setup.is_quick ? 20 : 600;
  const std::uint64_t at_once = after({double(seconds)});
  report.add("scrub_identical",
             after(std::vector<double>(std::size_t(seconds) * 4, 0.25)) == at_once ? 1.0 : 0.0);
  report.add("scrub_identical_a_second_later", after({double(seconds) + 1.0}) == at_once ? 1.0 : 0.0);
}

}  // namespace parvis::bench
