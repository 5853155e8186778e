#include "life/crowd/crowd.h"

#include <algorithm>
#include <cmath>

namespace parvis::crowd {
namespace {

constexpr float wall_reach_m = 1.2f;  // within which walls are looked for
constexpr float floor_apart_m = 1.5f, steepest_seen = 0.3f;
constexpr float away_level_m = -1e4f;  // below all ground
constexpr float corner_m = 0.5f;       // at which a corner is reached
constexpr float own_lean_m = 0.7f;     // corners are passed wider by up to it
constexpr float queue_lean_m = 0.4f;   // and by so much more at each look around in a queue
constexpr float widest_lean = 0.7f;    // by a fraction of this part of the room there
constexpr float widest_room_m = 30.0f;
constexpr float queue_speed = 0.6f;  // of the free speed
constexpr std::uint32_t turns = 4;   // a part of the people looks round in each step
constexpr float lost_s = 4.0f;       // blocked for so long: another way is sought
// Weidmann 1993: horizontal speeds on stairs.
constexpr float stair_slope = 0.35f, up_m_s = 0.61f, down_m_s = 0.694f;

// Groups (Moussaid, Perozo, Garnier, Helbing and Theraulaz 2010: people of a group walk abreast, 0.6 to 0.8 m
// apart where there is room).
constexpr float abreast_m = 0.75f, abreast_room_m = 0.15f, sideways = 0.45f;
constexpr float level_m = 0.25f, behind_m = 1.2f,
                lost_m = 12.0f;  // along the way; farther apart each walks alone
constexpr float catches_up = 1.2f, drops_back = 0.75f, waits_for = 0.55f;  // of the own speed

/// A number in 0..1 that follows from two others.
float fraction_of(std::uint32_t number, std::uint32_t use) {
  std::uint32_t x = number * 0x9e3779b9u + use * 0x85ebca6bu;
  x ^= x >> 16, x *= 0x7feb352du, x ^= x >> 15, x *= 0x846ca68bu, x ^= x >> 16;
  return float(x >> 8) / float(1u << 24);
}

glm::vec2 unit(glm::vec2 v) {
  const float length = glm::length(v);
  return length > 1e-5f ? v / length : glm::vec2(0.0f);
}

}  // namespace

Crowd::Crowd(NavMesh mesh, SteeringRules rules) : mesh_(std::move(mesh)), steering_(rules) { find_walls(); }

void Crowd::find_walls() { walls_ = Walls(mesh_.borders(), wall_reach_m); }

int Crowd::add(const Destination& destination) {
  destinations_.push_back(destination);
  return int(destinations_.size()) - 1;
}

std::optional<std::size_t> Crowd::add(glm::vec3 where, int destination, float speed, float radius_m,
                                      float waits_s) {
  const std::optional<glm::vec3> place = mesh_.nearest(where);
  if (!place) return std::nullopt;
  const std::size_t index = walkers_.add(*place, place->z, radius_m, speed);
  PersonOnTheWay person;
  person.number = next_number_++;
  person.waits_s = waits_s, person.own_speed = speed;
  person.lean_m = own_lean_m * fraction_of(person.number, 1);
  people_.push_back(std::move(person));
  if (destination < 0 || send(index, destination, waits_s)) return index;
  remove(index);
  return std::nullopt;
}

bool Crowd::send(std::size_t person, int destination, float waits_s) {
  const glm::vec2 from = walkers_.position[person];
  const Destination& to = destinations_[std::size_t(destination)];
  const glm::vec2 on_line = nearest_on_segment(to.a, to.b, from);
  const std::optional<Way> way =
      mesh_.way(glm::vec3(from, walkers_.height_m[person]), glm::vec3(on_line, 0.5f * (to.a.z + to.b.z)));
  if (!way) return false;
  PersonOnTheWay& it = people_[person];
  it.destination = destination, it.has_arrived = false, it.waits_s = waits_s;
  it.way = *way, it.corner = std::min<std::size_t>(1, way->size() - 1);
  return true;
}

int Crowd::quickest(std::size_t person, std::span<const int> destinations) const {
  constexpr float passing_per_m = 1.2f, narrowest_m = 0.5f;
  constexpr float loyalty = 0.65f;  // another one is chosen where it saves a third: others will, too
  const auto away_m = [&](std::size_t who, int destination) {
    const Destination& to = destinations_[std::size_t(destination)];
    return glm::distance(nearest_on_segment(to.a, to.b, walkers_.position[who]), walkers_.position[who]);
  };
  const auto seconds = [&](int destination) {
    const Destination& to = destinations_[std::size_t(destination)];
    const float way_m = away_m(person, destination);
    int before = 0;
    for (std::size_t i = 0; i < people_.size(); ++i)
      before +=
          i != person && people_[i].destination == destination && away_m(i, destination) < way_m ? 1 : 0;
    const float wait_s = float(before) / (passing_per_m * std::max(glm::distance(to.a, to.b), narrowest_m));
    return (people_[person].destination == destination ? loyalty : 1.0f) *
           (way_m / people_[person].own_speed + wait_s);
  };
  return *std::ranges::min_element(destinations, {}, seconds);
}

void Crowd::set_away(std::size_t person, bool is_away) {
  PersonOnTheWay& it = people_[person];
  it.is_away = is_away;
  if (!is_away) return;
  it.destination = -1, it.has_arrived = false;
  walkers_.height_m[person] = away_level_m, walkers_.velocity[person] = glm::vec2(0.0f);
}

void Crowd::put(std::size_t person, glm::vec3 where) {
  const glm::vec3 place = mesh_.nearest(where).value_or(where);
  walkers_.position[person] = place, walkers_.height_m[person] = place.z;
  set_away(person, false);
}

void Crowd::stand_back(std::size_t person, glm::vec2 before) {
  walkers_.position[person] = before, walkers_.velocity[person] = glm::vec2(0.0f);
}

void Crowd::remove(std::size_t person) {
  const int last = int(people_.size()) - 1;
  for (PersonOnTheWay& it : people_)
    it.leader = it.leader == int(person) ? -1 : it.leader == last ? int(person) : it.leader;
  walkers_.remove(person);
  std::swap(people_[person], people_.back());
  people_.pop_back();
}

glm::vec2 Crowd::outward(const PersonOnTheWay& person) const {
  const glm::vec2 corner = person.way[person.corner],
                  in = unit(corner - glm::vec2(person.way[person.corner - 1])),
                  out = unit(glm::vec2(person.way[person.corner + 1]) - corner);
  return unit(in - out);
}

float Crowd::room_at_corner(const PersonOnTheWay& person) const {
  constexpr float step_m = 0.5f;
  const glm::vec3 corner = person.way[person.corner];
  const glm::vec2 at(corner), away = outward(person);
  float room_m = 0.0f;
  while (room_m < widest_room_m && !walls_.crosses(at, at + (room_m + step_m) * away, corner.z))
    room_m += step_m;
  return room_m;
}

glm::vec2 Crowd::target_of(std::size_t person) const {
  const PersonOnTheWay& it = people_[person];
  const glm::vec2 corner = it.way[it.corner], here = walkers_.position[person];
  if (it.corner + 1 >= it.way.size()) {
    const Destination& to = destinations_[std::size_t(it.destination)];
    // Ends of doors are walls: they are walked to a body's width inside.
    const glm::vec2 along = to.b - to.a;
    const float length = glm::length(along), inside = std::min(0.5f, 0.3f / std::max(length, 0.3f));
    return nearest_on_segment(glm::vec2(to.a) + inside * along, glm::vec2(to.b) - inside * along, here);
  }
  const glm::vec2 wider = corner + it.lean_m * outward(it);
  return walls_.crosses(corner, wider, it.way[it.corner].z) ? corner : wider;
}

glm::vec2 Crowd::direction(std::size_t person) const {
  const PersonOnTheWay& it = people_[person];
  return it.destination < 0 || it.has_arrived || it.waits_s > 0.0f
             ? glm::vec2(0.0f)
             : unit(target_of(person) - walkers_.position[person]);
}

void Crowd::follow_way(std::size_t person) {
  PersonOnTheWay& it = people_[person];
  const glm::vec2 here = walkers_.position[person];
  while (it.corner + 1 < it.way.size()) {
    const glm::vec2 corner = it.way[it.corner], next = it.way[it.corner + 1];
    // Below or above, on another floor, is neither here nor in sight.
    const auto is_level = [&](glm::vec3 p) {
      const float rise_m = std::abs(p.z - walkers_.height_m[person]);
      return rise_m < std::max(floor_apart_m, steepest_seen * glm::distance(here, glm::vec2(p)));
    };
    const bool is_there = is_level(it.way[it.corner]) && (glm::distance(here, target_of(person)) < corner_m ||
                                                          glm::distance(here, corner) < corner_m);
    const bool sees_next =
        is_level(it.way[it.corner + 1]) && !walls_.crosses(here, next, walkers_.height_m[person]);
    // Else those who come round a corner in a wide queue would all turn to its inner wall again.
    const glm::vec2 on = unit(corner - glm::vec2(it.way[it.corner - 1])) + unit(next - corner);
    const bool is_wide = it.lean_m > own_lean_m, is_past = glm::dot(here - corner, on) > 0.0f;
    if (!is_there && !(sees_next && (is_past || !is_wide))) break;
    ++it.corner;
    it.lean_m = own_lean_m * fraction_of(it.number, 1);
  }
  // Who queues at a corner goes round it wider, where there is room.
  if (it.corner + 1 < it.way.size() &&
      glm::length(walkers_.velocity[person]) < queue_speed * walkers_.free_speed[person]) {
    const float before_m = it.lean_m;
    it.lean_m = std::max(before_m, std::min(before_m + queue_lean_m,
                                            widest_lean * fraction_of(it.number, 2) * room_at_corner(it)));
    if (target_of(person) == glm::vec2(it.way[it.corner])) it.lean_m = before_m;
  }
  const bool is_cut_off = walls_.crosses(here, it.way[it.corner], walkers_.height_m[person]);
  if (is_cut_off || walkers_.blocked_s[person] > lost_s) {
    const float blocked_s = walkers_.blocked_s[person];
    send(person, it.destination);
    walkers_.blocked_s[person] = std::fmod(blocked_s, lost_s) + 1.0f;
  }
}

void Crowd::look_at_ground(std::size_t person) {
  const glm::vec2 here = walkers_.position[person];
  const float height = walkers_.height_m[person];
  constexpr float ahead_m = 0.5f;
  const std::optional<glm::vec3> below = mesh_.nearest(glm::vec3(here, height), 0.5f);
  if (!below) return;
  walkers_.height_m[person] = below->z;
  const glm::vec2 before = here + ahead_m * walkers_.aim[person];
  const std::optional<glm::vec3> next = mesh_.nearest(glm::vec3(before, below->z), 0.5f);
  const float run = next ? glm::distance(glm::vec2(*next), glm::vec2(*below)) : 0.0f;
  people_[person].slope = run > 0.2f ? (next->z - below->z) / run : 0.0f;
}

/// Those who walk beside somebody keep abreast of them.
void Crowd::keep_together() {
  for (std::size_t i = 0; i < people_.size(); ++i) {
    const PersonOnTheWay& it = people_[i];
    if (it.leader < 0) continue;
    const auto leader = std::size_t(it.leader);
    const glm::vec2 way = walkers_.aim[leader], to = walkers_.position[leader] - walkers_.position[i];
    if (it.destination != people_[leader].destination || people_[leader].is_away || it.is_away) continue;
    if (way == glm::vec2(0.0f) || walkers_.aim[i] == glm::vec2(0.0f) || glm::length(to) > lost_m) continue;
    const float ahead = glm::dot(to, way);  // the leader is
    if (ahead > level_m) walkers_.free_speed[i] *= catches_up;
    if (ahead < -level_m) walkers_.free_speed[i] *= drops_back;
    if (ahead > behind_m) walkers_.free_speed[leader] *= waits_for;
    const float aside = to.x * way.y - to.y * way.x;  // positive: the leader is at the right
    const glm::vec2 left(-way.y, way.x);
    const float missing = abreast_m - std::abs(aside);
    if (std::abs(missing) < abreast_room_m) continue;
    const float away = (aside >= 0.0f ? 1.0f : -1.0f) * std::clamp(missing / abreast_m, -1.0f, 1.0f);
    walkers_.aim[i] = unit(walkers_.aim[i] + sideways * away * left);
  }
}

void Crowd::step(float step_s, std::span<const MovingBody> bodies) {
  for (std::size_t i = 0; i < people_.size(); ++i) {
    PersonOnTheWay& it = people_[i];
    it.waits_s = std::max(it.waits_s - step_s, 0.0f);
    walkers_.aim[i] = glm::vec2(0.0f);
    if (it.destination < 0 || it.has_arrived || it.waits_s > 0.0f || it.is_held || it.is_away) continue;
    const Destination& to = destinations_[std::size_t(it.destination)];
    const glm::vec2 here = walkers_.position[i];
    if (glm::distance(nearest_on_segment(to.a, to.b, here), here) < to.reach_m) {
      it.has_arrived = true;
      continue;
    }
    const bool looks = (it.number + steps_) % turns == 0;
    if (looks) follow_way(i);
    walkers_.aim[i] = unit(target_of(i) - here);
    if (looks) look_at_ground(i);
    // Along the slope on gentle ground; Weidmann's speeds on what is as steep as stairs.
    float speed = it.own_speed / std::sqrt(1.0f + it.slope * it.slope);
    if (it.slope > stair_slope) speed = std::min(speed, up_m_s);
    if (it.slope < -stair_slope) speed = std::min(speed, down_m_s);
    walkers_.free_speed[i] = speed;
  }
  keep_together();
  steering_.step(walkers_, walls_, bodies, step_s);
  ++steps_;
}

void Crowd::change_ground(const WalkingGround& ground, glm::vec2 low, glm::vec2 high) {
  mesh_.update(ground, low, high);
  find_walls();
  const glm::vec2 middle = 0.5f * (low + high);
  const float radius = 0.5f * glm::distance(low, high) + 1.0f;
  for (std::size_t i = 0; i < people_.size(); ++i) {
    PersonOnTheWay& it = people_[i];
    // Who stands where nobody can any more steps aside, onto what lies above or below where there is no
    // other way.
    constexpr float aside_m = 4.0f, step_m = 0.35f;
    const glm::vec3 here(walkers_.position[i], walkers_.height_m[i]);
    if (!it.is_away && glm::distance(glm::vec2(here), middle) < radius) {
      std::optional<glm::vec3> place = mesh_.nearest(here, aside_m, step_m);
      if (!place) place = mesh_.nearest(here, aside_m);
      if (place) walkers_.position[i] = *place, walkers_.height_m[i] = place->z;
    }
    // Who cannot get there any more has come as far as they can, and goes elsewhere.
    if (it.destination >= 0 && !it.has_arrived) it.has_arrived = !send(i, it.destination);
  }
}

}  // namespace parvis::crowd
