// People and cars about the main crossing of the paper's city: who touches whom, who stands in whose way, how
// far feet slide, and what a change of level shows.
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "bench/crowd/test_place.h"
#include "bench/parts.h"
#include "life/crowd/crowd_process.h"
#include "life/people/test_feet.h"
#include "life/traffic/traffic_process.h"

namespace parvis::bench {
namespace {

namespace fs = std::filesystem;

constexpr int people_of_square = 120;
constexpr float look_s = 0.1f;

stage::Simulation square(const BenchSetup& setup) {
  const fs::path script = setup.city() / "bench_square.xp";
  std::ofstream(script) << fmt::format(
      "include(file=\"paper.xp\")\ntrafficLights(position=\"-74 72 0\", beside=2.8)\n"
      "crowd(people={}, seed=5, centre=\"-74 72 0\", radius=80)\n",
      people_of_square);
  return setup.simulation(script);
}

/// Counts the beginnings of states: something that holds from look to look counts once.
template <class Key>
class Beginnings {
 public:
  void look(std::set<Key> now) {
    for (const Key& key : now) count_ += before_.contains(key) ? 0 : 1;
    before_ = std::move(now);
  }
  int count() const { return count_; }

 private:
  std::set<Key> before_;
  int count_ = 0;
};

/// Events in a square.
struct Seen {
  double person_hours = 0.0;
  Beginnings<std::size_t> in_walls, in_vehicles;
  Beginnings<std::pair<std::size_t, std::size_t>> in_people, in_paths, on_crossings;
  int straight_through_walls = 0;
  int at_red = 0;

  double per_person_hour(int count) const { return double(count) / person_hours; }
};

void look_round(const crowd::CrowdProcess& process,
                std::map<std::pair<std::size_t, std::size_t>, float>& stands_s, Seen& seen) {
  constexpr float touching_m = 0.03f;    // bodies are soft: less is no overlap
  constexpr float behind_wall_m = 0.1f;  // the mesh ends 0.24 m before walls
  constexpr float moving = 1.0f, standing = 0.1f, ahead_s = 0.5f, long_s = 3.0f;
  const crowd::Crowd& crowd = *process.crowd();
  const crowd::Walkers& walkers = crowd.walkers();
  const scene::StreetTraffic& streets = *process.streets();
  std::set<std::size_t> walls, vehicles;
  std::set<std::pair<std::size_t, std::size_t>> people, paths, crossings;
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    const glm::vec2 here = walkers.position[i];
    const std::optional<glm::vec3> on_mesh = crowd.mesh().nearest({here, walkers.height_m[i]}, 1.0f);
    if (!on_mesh || glm::distance(glm::vec2(*on_mesh), here) > behind_wall_m) walls.insert(i);
    for (std::size_t j = i + 1; j < walkers.size(); ++j)
      if (glm::distance(here, walkers.position[j]) < walkers.radius_m[i] + walkers.radius_m[j] - touching_m)
        people.emplace(i, j);
    for (std::size_t v = 0; v < streets.vehicles.size(); ++v) {
      const scene::StreetTraffic::Vehicle& vehicle = streets.vehicles[v];
      const glm::vec2 along = glm::normalize(vehicle.front - vehicle.rear), to = here - vehicle.rear;
      const float at = glm::dot(to, along), beside = std::abs(to.x * along.y - to.y * along.x),
                  length = glm::distance(vehicle.front, vehicle.rear), speed = glm::length(vehicle.velocity);
      const float reach = walkers.radius_m[i] - touching_m;
      if (at > -reach && at < length + reach && beside < vehicle.half_width_m + reach) vehicles.insert(i);
      if (speed > moving && at > length && at < length + ahead_s * speed && beside < vehicle.half_width_m)
        paths.emplace(i, v);
    }
  }
  for (std::size_t v = 0; v < streets.vehicles.size(); ++v)
    for (std::size_t c = 0; c < streets.crossings.size(); ++c) {
      const scene::StreetTraffic::Vehicle& vehicle = streets.vehicles[v];
      const bool stands =
          glm::length(vehicle.velocity) < standing && streets.people[c] != 0 &&
          (streets.crossings[c].contains(vehicle.front) || streets.crossings[c].contains(vehicle.rear) ||
           streets.crossings[c].contains(0.5f * (vehicle.front + vehicle.rear)));
      float& since_s = stands_s[{v, c}];
      since_s = stands ? since_s + look_s : 0.0f;
      if (since_s > long_s) crossings.emplace(v, c);
    }
  seen.in_walls.look(std::move(walls)), seen.in_vehicles.look(std::move(vehicles));
  seen.in_people.look(std::move(people)), seen.in_paths.look(std::move(paths));
  seen.on_crossings.look(std::move(crossings));
  seen.person_hours += double(walkers.size()) * double(look_s) / 3600.0;
}

/// Who crosses at red, from look to look.
class RedLights {
 public:
  /// Counts those who have stepped onto a crossing, or driven over a stop line, since the last look.
  int look(const crowd::Crowd& crowd, const scene::StreetTraffic& streets,
           const traffic::Simulation& traffic) {
    int count = 0;
    constexpr float left_m = 0.5f;  // of a crossing that somebody has left
    for (std::size_t i = 0; i < crowd.size(); ++i)
      for (std::size_t c = 0; c < streets.crossings.size(); ++c) {
        const glm::vec2 here = crowd.walkers().position[i];
        bool& is_on = is_on_[{i, c}];
        const bool was_on = is_on;
        is_on = streets.crossings[c].contains(here, was_on ? left_m : 0.0f);
        count += has_looked_ && is_on && !was_on && streets.lights[c] == scene::WalkLight::wait ? 1 : 0;
      }
    fronts_.resize(traffic.vehicles().size());
    const std::vector<traffic::SignalJunction>& junctions = traffic.signals().junctions();
    for (std::size_t v = 0; v < fronts_.size(); ++v) {
      const glm::vec2 front = streets.vehicles[v].front, before = std::exchange(fronts_[v], front);
      for (std::size_t j = 0; has_looked_ && j < junctions.size(); ++j)
        for (const traffic::SignalApproach& approach : junctions[j].approaches) {
          const glm::vec2 stop(approach.stop);
          const bool passes = glm::dot(before - stop, approach.away) > 0.0f &&
                              glm::dot(front - stop, approach.away) <= 0.0f &&
                              glm::distance(front, stop) < approach.half_width_m + 0.5f;
          count += passes && traffic.signals().light(j, approach.phase) == traffic::DriveLight::red ? 1 : 0;
        }
    }
    has_looked_ = true;
    return count;
  }

 private:
  std::map<std::pair<std::size_t, std::size_t>, bool> is_on_;
  std::vector<glm::vec2> fronts_;
  bool has_looked_ = false;
};

Seen watch(stage::Simulation& simulation, float seconds) {
  Seen seen;
  RedLights red;
  const auto* traffic = simulation.clock.find<traffic::TrafficProcess>();
  const auto* process = simulation.clock.find<crowd::CrowdProcess>();
  if (!process || !process->crowd() || !process->streets()) fail("nobody walks in the square");
  std::map<std::pair<std::size_t, std::size_t>, float> stands_s;
  for (float time_s = 0.0f; time_s < seconds; time_s += look_s) {
    simulation.advance(double(look_s));
    look_round(*process, stands_s, seen);
    seen.at_red += red.look(*process->crowd(), *process->streets(), traffic->traffic().simulation());
  }
  const crowd::Crowd& crowd = *process->crowd();
  for (std::size_t i = 0; i < crowd.size(); ++i)
    if (const int to = crowd.people()[i].destination; to >= 0)
      seen.straight_through_walls += crowd.walls().crosses(crowd.walkers().position[i],
                                                           glm::vec2(crowd.destinations()[std::size_t(to)].a),
                                                           crowd.walkers().height_m[i])
                                         ? 1
                                         : 0;
  return seen;
}

/// Slides of the feet of people of the square, led where the crowd leads them; `factor` stretches their ways.
double foot_slide_cm(stage::Simulation& simulation, float seconds, float factor) {
  constexpr std::size_t watched = 20;
  const auto* process = simulation.clock.find<crowd::CrowdProcess>();
  const auto lead_of = [&](std::size_t p) {
    const glm::mat4& m = std::ranges::find_if(simulation.scene.objects, [&](const scene::Object& object) {
                           return object.is_visible && object.name == crowd::person_name(p);
                         })->world_from_model;
    return people::Lead{{m[3].x, m[3].y, 0.0f}, std::atan2(m[0].y, m[0].x)};
  };
  std::vector<people::WalkingBody> bodies;
  std::vector<people::SlideMeter> meters(watched);
  for (std::size_t p = 0; p < watched; ++p)
    bodies.emplace_back(process->generated()->body(p), lead_of(p), float(p));
  for (float time_s = 0.0f; time_s < seconds; time_s += look_s) {
    simulation.advance(double(look_s));
    for (std::size_t p = 0; p < watched; ++p) {
      bodies[p].step(lead_of(p), look_s, [](glm::vec3) { return 0.0f; });
      for (int f = 0; f < 6; ++f) {
        const float part = float(f) / 6.0f;
        people::Lead lead = bodies[p].lead_at(part);
        const people::Posture posture = bodies[p].posture_at(part);
        lead.place *= factor;
        meters[p].add(people::contact_points(process->generated()->body(p), lead, posture));
      }
    }
  }
  std::vector<double> slides;
  for (people::SlideMeter& meter : meters) slides.push_back(100.0 * double(meter.slide_m()));
  return *std::ranges::max_element(slides);
}

/// The largest FLIP, over the pixels of one person, of two pictures between which the person's level of
/// detail changes while the eye moves by a centimetre; `apart_m` of the eyes.
double switch_flip(const BenchSetup& setup, float apart_m) {
  const fs::path script = setup.folder / "one_person.xp";
  std::ofstream(script) << "terrain_plane(surface=\"paving\")\nsun(azimuth_deg=200, elevation_deg=45, "
                           "irradiance=\"10 9 7\")\nexposure(value=1.2)\n"
                           "crowd(people=1, seed=3, radius=20)\ncamera(name=\"eye\", position=\"0 0 1.6\", "
                           "target=\"10 0 1.6\", fov_deg=55)\n";
  const auto stage = stage_of(setup.simulation(script));
  const glm::vec3 person(std::ranges::find_if(stage->scene().objects, [](const scene::Object& object) {
                           return object.is_visible && object.name == crowd::person_name(0);
                         })->world_from_model[3]);
  Camera camera = must(stage->camera("eye"));
  const auto level = [&] {
    return stage->simulation().clock.find<crowd::CrowdProcess>()->generated()->level(0);
  };
  const auto picture = [&](float distance_m) {
    const glm::vec3 chest = person + glm::vec3(0.0f, 0.0f, 1.2f);
    camera.world_from_camera = look_at(chest + glm::vec3(distance_m, 0.0f, 0.0f), chest);
    stage->draw(camera, 1280, 720);
    return stage->picture();
  };
  double worst = 0.0;
  for (const float reach_m : crowd::ShownPeople::reach_m) {
    picture(1.3f * reach_m);  // the coarser level
    const Image8 far = picture(reach_m + 0.5f * apart_m);
    const people::Detail coarser = level();
    const Image8 near = picture(reach_m - 0.5f * apart_m);
    if (level() == coarser) fail("the level of detail does not change at {} m", reach_m);
    Image8 mask(far.width, far.height, 1);
    const float focal_px = 360.0f / std::tan(glm::radians(27.5f));
    const int half_w = int(0.45f / reach_m * focal_px), half_h = int(1.2f / reach_m * focal_px);
    for (int y = std::max(0, far.height / 2 - half_h); y < std::min(far.height, far.height / 2 + half_h); ++y)
      for (int x = std::max(0, far.width / 2 - half_w); x < std::min(far.width, far.width / 2 + half_w); ++x)
        mask.pixels[std::size_t(y) * std::size_t(far.width) + std::size_t(x)] = 255;
    worst = std::max(worst, flip_between(near, far, mask));
  }
  return worst;
}

}  // namespace

void measure_square(const BenchSetup& setup, Report& report) {
  const float seconds = setup.is_quick ? 60.0f : 3600.0f;
  stage::Simulation simulation = square(setup);
  const Seen seen = watch(simulation, seconds);
  report.note(fmt::format("{} people and {} cars for {:.0f} s", people_of_square,
                          simulation.clock.find<crowd::CrowdProcess>()->streets()->vehicles.size(), seconds));
  report.add("overlaps_per_person_hour_walls", seen.per_person_hour(seen.in_walls.count()));
  report.add("overlaps_per_person_hour_walls_straight", seen.per_person_hour(seen.straight_through_walls));
  report.add("overlaps_per_person_hour_vehicles", seen.per_person_hour(seen.in_vehicles.count()));
  report.add("overlaps_per_person_hour_people", seen.per_person_hour(seen.in_people.count()));
  report.add("people_in_vehicles_paths", double(seen.in_paths.count()));
  report.add("blocked_crossings", double(seen.on_crossings.count()));
  report.add("red_light_crossings", double(seen.at_red));
  stage::Simulation unheeded = square(setup);
  traffic::Simulation& drivers = unheeded.clock.find<traffic::TrafficProcess>()->traffic().simulation();
  drivers.heeds_signals = drivers.heeds_crossings = drivers.keeps_crossings_free = false;
  auto* walkers = unheeded.clock.find<crowd::CrowdProcess>();
  walkers->heeds_lights = walkers->heeds_vehicles = false;
  const Seen without = watch(unheeded, std::max(seconds / 10.0f, 120.0f));
  report.add("blocked_crossings_unheeded", double(without.on_crossings.count()));
  report.add("red_light_crossings_unheeded", double(without.at_red));
  report.add("people_in_vehicles_paths_unheeded", double(without.in_paths.count()));
  report.add("overlaps_per_person_hour_vehicles_unheeded",
             without.per_person_hour(without.in_vehicles.count()));
  report.add("foot_slide_cm", foot_slide_cm(simulation, 20.0f, 1.0f));
  report.add("foot_slide_cm_stretched", foot_slide_cm(simulation, 10.0f, 1.1f));
}

void measure_levels(const BenchSetup& setup, Report& report) {
  report.add("impostor_switch_flip", switch_flip(setup, 0.02f));
  report.add("impostor_switch_flip_of_a_step", switch_flip(setup, 0.7f));
}

}  // namespace parvis::bench
