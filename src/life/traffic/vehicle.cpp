#include "life/traffic/vehicle.h"

#include <algorithm>
#include <cassert>

namespace parvis::traffic {

namespace {

constexpr float memory_m = 1.5f;  // of the way behind the tail: display looks back by a step's move

float length_of(std::span<const DrivingLane> lanes, int lane) {
  return lanes[std::size_t(lane)].path.length();
}

/// One of the lanes that lead least far out of the area, at random.
int turn(const std::vector<int>& next, std::span<const DrivingLane> lanes, Random& random) {
  const auto outside_m = [&](int lane) { return lanes[std::size_t(lane)].outside_m; };
  const float min_m = outside_m(std::ranges::min(next, {}, outside_m));
  int chance = random.index(int(std::ranges::count(next, min_m, outside_m)));
  return *std::ranges::find_if(next, [&](int lane) { return outside_m(lane) == min_m && chance-- == 0; });
}

}  // namespace

void Vehicle::plan(std::span<const DrivingLane> lanes) {
  float ahead_m = -front_m;
  for (std::size_t i = current; i < route.size(); ++i) ahead_m += length_of(lanes, route[i]);
  while (route.size() < longest_route &&
         (ahead_m < planned_ahead_m || !can_rest_on(lanes[std::size_t(route.back())]))) {
    route.push_back(turn(lanes[std::size_t(route.back())].next, lanes, random));
    ahead_m += length_of(lanes, route.back());
  }
}

void Vehicle::plan_anew(std::size_t index, std::span<const DrivingLane> lanes) {
  assert(index > current && index >= held_until);
  route.resize(index);
  plan(lanes);
}

void Vehicle::advance(float distance_m, std::span<const DrivingLane> lanes, RightOfWay& rights) {
  last_move_m = distance_m;
  travelled_m += double(distance_m);
  front_m += distance_m;
  while (front_m > length_of(lanes, lane()) && current + 1 < route.size()) {
    front_m -= length_of(lanes, lane());
    ++current;
  }

  float behind_m = front_m;
  for (std::size_t i = current; i-- > 1;) behind_m += length_of(lanes, route[i]);
  while (current > 0 && behind_m > length_m() + memory_m) {
    if (lanes[std::size_t(route.front())].is_shared) rights.release(route.front());
    route.erase(route.begin());
    --current, held_until -= held_until > 0 ? 1 : 0;
    if (current > 0) behind_m -= length_of(lanes, route.front());
  }
}

void Vehicle::note_presence(int index, std::span<const DrivingLane> lanes, Occupancy& occupancy) const {
  float tail_m = front_m - length_m();
  for (std::size_t i = current;; --i) {
    occupancy.add(route[i], {index, std::max(tail_m, 0.0f), front_m, i == current, speed});
    if (tail_m >= 0.0f || i == 0) return;
    tail_m += length_of(lanes, route[i - 1]);
  }
}

glm::vec3 Vehicle::point_behind(float distance_m, std::span<const DrivingLane> lanes) const {
  float along = front_m - distance_m;
  std::size_t i = current;
  while (along < 0.0f && i > 0) along += length_of(lanes, route[--i]);
  for (; along > length_of(lanes, route[i]) && i + 1 < route.size(); ++i) along -= length_of(lanes, route[i]);
  return lanes[std::size_t(route[i])].path.at(along);
}

glm::vec3 Vehicle::front_axle(float back_m, std::span<const DrivingLane> lanes) const {
  return point_behind(back_m + shape->front_overhang_m(), lanes);
}

glm::vec3 Vehicle::rear_axle(float back_m, std::span<const DrivingLane> lanes) const {
  return point_behind(back_m + shape->front_overhang_m() + shape->wheelbase_m(), lanes);
}

Footprint Vehicle::footprint(float back_m, std::span<const DrivingLane> lanes) const {
  return shape->footprint(rear_axle(back_m, lanes), front_axle(back_m, lanes));
}

float Vehicle::steering(float back_m, std::span<const DrivingLane> lanes) const {
  constexpr float reach_m = 0.6f;  // over which the way's direction is taken: longer than a lane's chords
  const glm::vec3 front = front_axle(back_m, lanes), rear = rear_axle(back_m, lanes);
  const float behind_m = back_m + shape->front_overhang_m();
  const glm::vec3 chord = point_behind(behind_m - reach_m, lanes) - point_behind(behind_m + reach_m, lanes);
  const glm::vec3 body = front - rear;
  return std::atan2(scene::cross_in_plan(body, chord), body.x * chord.x + body.y * chord.y);
}

}  // namespace parvis::traffic
