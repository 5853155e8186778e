#include "life/traffic/lane_network.h"

#include <algorithm>
#include <cmath>

#include "base/bounds.h"
#include "base/parallel.h"
#include "life/traffic/street_ends.h"

namespace parvis::traffic {

namespace {

constexpr float sweep_step_m = 1.0f;
constexpr float sweep_margin_m = 0.12f;  // on each side of the largest vehicle
constexpr float entry_margin_m = 1.4f;   // less than Vehicle remembers of the way behind its tail
constexpr float exit_margin_m = 1.8f;    // less than Driver's standing gap
constexpr float street_end_m = 8.0f;     // as far as a turning bus swings into it
constexpr float slowest = 1.5f;          // m/s: however tight the curve
constexpr float bridge_clearance_m = 3.0f;

/// The places of a vehicle that passes along a lane.
struct Sweep {
  Bounds bounds;
  std::vector<Footprint> footprints;
  std::vector<float> heights_m;
};

/// Lanes from which one can drive on for ever: the others are taken away until none is left to take.
void keep_lanes_that_lead_on(std::vector<DrivingLane>& lanes) {
  bool has_changed = true;
  while (has_changed) {
    has_changed = false;
    for (DrivingLane& lane : lanes) {
      std::erase_if(lane.next, [&](int next) { return !lanes[std::size_t(next)].is_usable; });
      if (lane.is_usable && lane.next.empty()) lane.is_usable = false, has_changed = true;
    }
  }
}

/// Speed at each metre: by the curvature over a car's length, then so that braking reaches it in time.
std::vector<float> safe_speeds(const scene::MeasuredPath& path, float limit, float braking) {
  constexpr float reach_m = 1.5f;
  const std::size_t count = std::size_t(std::ceil(path.length())) + 1;
  std::vector<float> speeds(count);
  for (std::size_t i = 0; i < count; ++i) {
    const float along = std::min(float(i), path.length());
    const glm::vec2 before = glm::normalize(glm::vec2(path.direction_at(std::max(along - reach_m, 0.0f))));
    const glm::vec2 after =
        glm::normalize(glm::vec2(path.direction_at(std::min(along + reach_m, path.length()))));
    const float turn = std::acos(std::clamp(glm::dot(before, after), -1.0f, 1.0f));
    const float curve_speed = std::sqrt(lateral_acceleration * 2.0f * reach_m / std::max(turn, 1e-3f));
    speeds[i] = std::clamp(curve_speed, std::min(slowest, limit), limit);
  }
  for (std::size_t i = count - 1; i-- > 0;)
    speeds[i] = std::min(speeds[i], std::sqrt(speeds[i + 1] * speeds[i + 1] + 2.0f * braking));
  return speeds;
}

/// A vehicle as long, as wide and with as large overhangs as any.
VehicleShape largest(const std::vector<VehicleShape>& shapes) {
  VehicleShape result = shapes.front();
  for (const VehicleShape& shape : shapes) {
    result.half_width_m = std::max(result.half_width_m, shape.half_width_m);
    if (shape.length_m() <= result.length_m()) continue;
    const float width = result.half_width_m;
    result = shape, result.half_width_m = width;
  }
  result.half_width_m += sweep_margin_m;
  return result;
}

/// A turning lane's vehicle reaches back and forth over the lane's ends, and so it does over the cuts of a
/// street. From crossings a street's vehicle keeps away: it holds the turning lane still when its tail
/// enters, and holds the next when its front comes nearer than it would wait.
Sweep sweep_along(const scene::MeasuredPath& path, LanePart part, const VehicleShape& shape) {
  const float half = 0.5f * shape.length_m();
  const bool leaves_crossing = part == LanePart::street || part == LanePart::first_metres;
  const bool meets_crossing = part == LanePart::street || part == LanePart::last_metres;
  float from = leaves_crossing ? half + entry_margin_m : -half;
  float to = path.length() + (meets_crossing ? -half - exit_margin_m : half);
  if (from > to) from = to = 0.5f * path.length();
  const int steps = std::max(1, int(std::ceil((to - from) / sweep_step_m)));
  Sweep sweep;
  for (int i = 0; i <= steps; ++i) {
    const float centre = glm::mix(from, to, float(i) / float(steps));
    const glm::vec3 rear = path.at(centre - half - shape.rear_m + shape.rear_axle_m);
    const glm::vec3 front = path.at(centre + half - shape.front_overhang_m());
    sweep.footprints.push_back(shape.footprint(rear, front));
    sweep.heights_m.push_back(rear.z);
    const float radius = half + shape.half_width_m;
    const glm::vec3 middle(sweep.footprints.back().centre, rear.z);
    sweep.bounds.add(middle - glm::vec3(radius));
    sweep.bounds.add(middle + glm::vec3(radius));
  }
  return sweep;
}

bool touch(const Sweep& a, const Sweep& b) {
  if (glm::any(glm::greaterThan(a.bounds.min, b.bounds.max)) ||
      glm::any(glm::greaterThan(b.bounds.min, a.bounds.max)))
    return false;
  for (std::size_t i = 0; i < a.footprints.size(); ++i)
    for (std::size_t j = 0; j < b.footprints.size(); ++j)
      if (std::abs(a.heights_m[i] - b.heights_m[j]) < bridge_clearance_m &&
          overlap(a.footprints[i], b.footprints[j]))
        return true;
  return false;
}

/// Whether a vehicle that leaves lane `first` drives on `second`, at once or after some metres of a street's
/// end: then they meet one behind the other, whom distance keeps apart.
bool leads_on_to(const std::vector<DrivingLane>& lanes, const std::vector<LanePart>& parts, int first,
                 int second) {
  return std::ranges::any_of(lanes[std::size_t(first)].next, [&](int next) {
    const LanePart part = parts[std::size_t(next)];
    const bool is_end = part == LanePart::first_metres || part == LanePart::last_metres;
    return next == second || (is_end && std::ranges::count(lanes[std::size_t(next)].next, second) > 0);
  });
}

void find_conflicts(std::vector<DrivingLane>& lanes, const std::vector<LanePart>& parts,
                    const VehicleShape& shape) {
  std::vector<Sweep> sweeps(lanes.size());
  parallel_for(lanes.size(), [&](std::size_t i) {
    if (lanes[i].is_usable) sweeps[i] = sweep_along(lanes[i].path, parts[i], shape);
  });
  parallel_for(lanes.size(), [&](std::size_t i) {
    for (std::size_t j = 0; j < lanes.size(); ++j) {
      const bool follow_one_another =
          leads_on_to(lanes, parts, int(i), int(j)) || leads_on_to(lanes, parts, int(j), int(i));
      if (i != j && !follow_one_another && touch(sweeps[i], sweeps[j])) lanes[i].conflicts.push_back(int(j));
    }
  });
  for (DrivingLane& lane : lanes) lane.is_shared = !lane.conflicts.empty();
}

/// A lane in a crossing is judged by the end of the street it leads to, since that is when the turn is
/// chosen.
void measure_ways_out(std::vector<DrivingLane>& lanes, const std::vector<LanePart>& parts, const Area& area) {
  const auto street_end = [&](int lane) {
    if (parts[std::size_t(lane)] == LanePart::first_metres)
      for (int cut = 0; cut < 2; ++cut) lane = lanes[std::size_t(lane)].next.front();
    return area.outside_m(glm::vec2(lanes[std::size_t(lane)].path.points().back()));
  };
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    if (!lanes[i].is_usable) continue;
    lanes[i].outside_m = std::numeric_limits<float>::max();
    if (parts[i] == LanePart::turn)
      for (const int next : lanes[i].next)
        lanes[i].outside_m = std::min(lanes[i].outside_m, street_end(next));
    else
      lanes[i].outside_m = street_end(int(i));
  }
}

}  // namespace

float DrivingLane::safe_speed_at(float distance_m) const {
  const float last = float(safe_speeds.size() - 1);
  const float place = std::clamp(distance_m, 0.0f, last);
  const std::size_t i = std::min(std::size_t(place), safe_speeds.size() - 2);
  return glm::mix(safe_speeds[i], safe_speeds[i + 1], place - float(i));
}

std::vector<DrivingLane> driving_lanes(const scene::RoadGraph& roads, const std::vector<VehicleShape>& shapes,
                                       float comfortable_braking, const Area& area) {
  const CutStreets cut = cut_streets(roads, street_end_m);
  std::vector<DrivingLane> lanes(cut.roads.lanes.size());
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    const scene::Lane& lane = cut.roads.lanes[i];
    lanes[i].path = scene::MeasuredPath::in_plan(scene::without_repeats(lane.points));
    lanes[i].next = lane.next;
    lanes[i].is_usable = true;
    lanes[i].safe_speeds = safe_speeds(lanes[i].path, lane.speed_limit, comfortable_braking);
  }
  keep_lanes_that_lead_on(lanes);
  measure_ways_out(lanes, cut.parts, area);
  if (!shapes.empty()) find_conflicts(lanes, cut.parts, largest(shapes));
  return lanes;
}

}  // namespace parvis::traffic
