#include "life/traffic/signals.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/data/path.h"

namespace parvis::traffic {
namespace {

constexpr float yellow_s = 3.0f, all_red_s = 2.0f;
constexpr float walking_m_s = 1.2f, first_step_s = 1.0f;  // of people who clear a crossing
constexpr float shortest_walk_s = 6.0f;
constexpr float tram_s = 14.0f;  // people's clearing, yellow and all red fit into it
constexpr float reach_m = 30.0f;
constexpr float line_before_stripes_m = 1.0f, seeks_line_m = 20.0f;
constexpr float facing = -0.7f, beside = 0.9f;  // cosines between streets, seen from the junction
constexpr int min_arms = 3;

/// Streets of a junction, by their directions away from it.
class Arms {
 public:
  explicit Arms(bool joins_facing) : joins_facing_(joins_facing) {}
  /// The number of the arm, or of the pair of arms that face each other; a new one where it is none yet.
  int of(glm::vec2 away) {
    if (const int known = find(away); known >= 0) return known;
    arms_.push_back({away});
    return int(arms_.size()) - 1;
  }
  int find(glm::vec2 away) const {
    for (std::size_t i = 0; i < arms_.size(); ++i)
      for (const glm::vec2 other : arms_[i])
        if (const float c = glm::dot(other, away); c > beside || (joins_facing_ && c < facing)) return int(i);
    return -1;
  }
  int count() const { return int(arms_.size()); }

 private:
  bool joins_facing_;
  std::vector<std::vector<glm::vec2>> arms_;
};

/// A junction of the road graph.
struct Junction {
  std::vector<int> turns, ins, outs;  ///< lanes
  glm::vec3 sum{0.0f};
  int points = 0;

  glm::vec3 middle() const { return sum / float(std::max(points, 1)); }
};

std::map<int, Junction> junctions_of(const scene::RoadGraph& roads) {
  std::map<int, Junction> junctions;
  for (std::size_t i = 0; i < roads.lanes.size(); ++i) {
    const scene::Lane& lane = roads.lanes[i];
    for (const int next : lane.next)
      if (const int to = roads.lanes[std::size_t(next)].crossing; to >= 0 && lane.crossing < 0) {
        if (std::vector<int>& ins = junctions[to].ins; ins.empty() || ins.back() != int(i))
          ins.push_back(int(i));
      } else if (lane.crossing >= 0 && to < 0) {
        junctions[lane.crossing].outs.push_back(next);
      }
    if (lane.crossing < 0) continue;
    Junction& junction = junctions[lane.crossing];
    junction.turns.push_back(int(i));
    for (const glm::vec3 p : lane.points) junction.sum += p, ++junction.points;
  }
  return junctions;
}

glm::vec2 away_of(const scene::Lane& lane, bool leads_in) {
  const std::vector<glm::vec3>& p = lane.points;
  const glm::vec2 away = leads_in ? p[p.size() - 2] - p.back() : p[1] - p[0];
  return away / std::max(glm::length(away), 1e-6f);
}

int arms_of(const scene::RoadGraph& roads, const Junction& junction) {
  Arms arms(false);
  for (const int lane : junction.ins) arms.of(away_of(roads.lanes[std::size_t(lane)], true));
  for (const int lane : junction.outs) arms.of(away_of(roads.lanes[std::size_t(lane)], false));
  return arms.count();
}

/// The distance of a lane's stop line from its end: before the crossing that it leads over.
float line_before_end(const scene::MeasuredPath& path, std::span<const scene::StreetCrossing> crossings) {
  float line_m = line_before_stripes_m;
  for (const scene::StreetCrossing& crossing : crossings)
    for (float back_m = 0.0f; back_m < std::min(seeks_line_m, path.length()); back_m += 0.25f)
      if (crossing.contains(glm::vec2(path.at(path.length() - back_m))))
        line_m = std::max(line_m, back_m + line_before_stripes_m);
  return std::min(line_m, 0.9f * path.length());
}

}  // namespace

Result<SignalJunction> signals_at(const scene::RoadGraph& roads,
                                  std::span<const scene::StreetCrossing> crossings,
                                  const SignalDemand& demand) {
  const Junction* nearest = nullptr;
  SignalJunction lights;
  float best_m = reach_m;
  const std::map<int, Junction> junctions = junctions_of(roads);
  for (const auto& [number, junction] : junctions) {
    const float away_m = glm::distance(glm::vec2(junction.middle()), glm::vec2(demand.position));
    if (away_m > best_m || arms_of(roads, junction) < min_arms) continue;
    best_m = away_m, nearest = &junction, lights.junction = number;
  }
  if (!nearest)
    return error(
        "trafficLights: no junction of three streets lies within {:.0f} m of {:.1f} {:.1f}; place it in the "
        "middle of one",
        reach_m, demand.position.x, demand.position.y);
  lights.middle = nearest->middle();
  lights.offset_s = demand.offset_s, lights.beside_m = demand.beside_m;
  std::vector<scene::StreetCrossing> own;
  for (const scene::StreetCrossing& crossing : crossings)
    if (crossing.junction == lights.junction) own.push_back(crossing);
  Arms phases(true);
  for (const int lane : nearest->ins) {
    const scene::Lane& it = roads.lanes[std::size_t(lane)];
    const scene::MeasuredPath path(it.points);
    SignalApproach approach;
    approach.lane = lane, approach.away = away_of(it, true), approach.phase = phases.of(approach.away);
    approach.line_m = line_before_end(path, own);
    approach.stop = path.at(path.length() - approach.line_m), approach.half_width_m = 0.5f * it.width_m;
    lights.approaches.push_back(approach);
  }
  lights.phases = phases.count();
  float longest_s = 0.0f;
  for (std::size_t c = 0; c < crossings.size(); ++c) {
    const scene::StreetCrossing& crossing = crossings[c];
    if (crossing.junction != lights.junction) continue;
    const glm::vec2 across(crossing.b - crossing.a),
        out = glm::vec2(0.5f * (crossing.a + crossing.b)) - glm::vec2(lights.middle);
    glm::vec2 away = glm::normalize(glm::vec2(-across.y, across.x));
    if (glm::dot(away, out) < 0.0f) away = -away;
    lights.walks.push_back({int(c), phases.find(away), first_step_s + glm::length(across) / walking_m_s,
                            crossing.a, crossing.b, crossing.half_width_m});
    longest_s = std::max(longest_s, lights.walks.back().clearing_s);
  }
  for (SignalWalk& walk : lights.walks) walk.clearing_s = longest_s;
  lights.green_s = std::max(demand.green_s, longest_s + shortest_walk_s);
  return lights;
}

Signals::Signals(std::vector<SignalJunction> junctions, const scene::RoadGraph& roads, std::size_t crossings)
    : junctions_(std::move(junctions)),
      approach_of_(roads.lanes.size(), {-1, -1}),
      walk_(crossings, scene::WalkLight::none),
      lane_points_(roads.lanes.size()) {
  for (std::size_t j = 0; j < junctions_.size(); ++j) {
    const SignalJunction& it = junctions_[j];
    turns_.emplace_back(std::size_t(it.phases));
    for (std::size_t a = 0; a < it.approaches.size(); ++a)
      for (const int turn : roads.lanes[std::size_t(it.approaches[a].lane)].next) {
        approach_of_[std::size_t(turn)] = {int(j), int(a)};
        turns_[j][std::size_t(it.approaches[a].phase)].push_back(turn);
        const scene::MeasuredPath path(roads.lanes[std::size_t(turn)].points);
        for (float at = 0.0f; at < path.length(); at += 0.5f)
          lane_points_[std::size_t(turn)].emplace_back(path.at(at));
      }
    states_.push_back({0, 0.0f, it.green_s});
    const float phase_s = it.green_s + yellow_s + all_red_s;
    states_[j].phase = int(std::fmod(it.offset_s / phase_s, float(std::max(it.phases, 1))));
    states_[j].since_s = std::fmod(it.offset_s, phase_s);
  }
  step(0.0f, {});
}

bool Signals::is_barred(const SignalJunction& junction, std::size_t number, int phase,
                        std::span<const scene::RailCrossing> rails) const {
  const auto crosses = [&](int turn) {
    return std::ranges::any_of(rails, [&](const scene::RailCrossing& rail) {
      return rail.tram_in_s < tram_s && std::abs(rail.strip.a.z - junction.middle.z) < 3.0f &&
             std::ranges::any_of(lane_points_[std::size_t(turn)],
                                 [&](glm::vec2 p) { return rail.strip.contains(p); });
    });
  };
  const std::vector<int>& turns = turns_[number][std::size_t(phase)];
  return 2 * std::ranges::count_if(turns, crosses) > std::ssize(turns);
}

void Signals::step(float seconds, std::span<const scene::RailCrossing> rails) {
  const bool has_tram =
      std::ranges::any_of(rails, [](const scene::RailCrossing& rail) { return rail.tram_in_s < tram_s; });
  for (std::size_t j = 0; j < junctions_.size(); ++j) {
    const SignalJunction& it = junctions_[j];
    State& state = states_[j];
    const auto barred = [&](int phase) { return has_tram && is_barred(it, j, phase, rails); };
    /// The next phase that may have green; -1: none.
    const auto next_phase = [&] {
      for (int k = 1; k <= it.phases; ++k)
        if (const int phase = (state.phase + k) % it.phases; !barred(phase)) return phase;
      return -1;
    };
    state.since_s += seconds;
    if (state.since_s < state.green_s) {
      const float clearing_s = it.walks.empty() ? 0.0f : it.walks.front().clearing_s;
      if (barred(state.phase)) state.green_s = std::min(state.green_s, state.since_s + clearing_s);
    } else if (has_tram && state.since_s < state.green_s + seconds && next_phase() == state.phase) {
      state.green_s += seconds;  // nobody else may drive
    }
    if (state.since_s >= state.green_s + yellow_s + all_red_s) {
      if (const int next = next_phase(); next >= 0)  // else all stay red
        state.phase = next, state.since_s = 0.0f, state.green_s = it.green_s;
    }
    for (const SignalWalk& walk : it.walks)
      walk_[std::size_t(walk.crossing)] =
          state.phase != walk.phase && state.since_s < state.green_s - walk.clearing_s
              ? scene::WalkLight::walk
              : scene::WalkLight::wait;
  }
}

DriveLight Signals::light(std::size_t junction, int phase) const {
  const State& state = states_[junction];
  if (phase != state.phase || state.since_s >= state.green_s + yellow_s) return DriveLight::red;
  return state.since_s < state.green_s ? DriveLight::green : DriveLight::yellow;
}

Signals::Gate Signals::gate(int turn) const {
  if (std::size_t(turn) >= approach_of_.size()) return {};
  const auto [junction, approach] = approach_of_[std::size_t(turn)];
  if (junction < 0) return {};
  const SignalApproach& it = junctions_[std::size_t(junction)].approaches[std::size_t(approach)];
  return {true, it.line_m, light(std::size_t(junction), it.phase)};
}

}  // namespace parvis::traffic
