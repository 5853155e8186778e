#include "life/crowd/steering.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "life/crowd/avoidance.h"

namespace parvis::crowd {
namespace {

constexpr float reach_m = 3.6f;           // within which others are seen
constexpr float near_cell_m = 1.8f;       // half of it: two rings of cells
constexpr int max_cells_per_side = 1024;  // beyond that cells grow
constexpr float storey_m = 1.6f;          // whose ground is farther above or below is on another level
constexpr std::size_t max_walls = 5;      // that are cleared at once
constexpr std::size_t max_bodies = 4;     // likewise: vehicles
constexpr float body_reach_m = 9.0f;      // within which they are cleared
constexpr float max_behind_m =
    0.22f;                      // a wall; who is farther behind it stands on the ground of its other side
constexpr int separations = 3;  // rounds of pushing apart
constexpr float slow = 0.2f, patience_s = 1.0f;  // of the free speed; until somebody is blocked
constexpr float squeezes_after_s = 0.8f, squeezing_s = 1.0f, shoulders_turned = 0.25f;
constexpr float free_way_m = 1e9f;
constexpr float along_horizon_s = 0.4f;  // for which those are cleared who walk the same way
constexpr float same_way = 0.97f;        // cosine of the angle between aims: behind one another
constexpr float content = 0.9f;          // of the free speed: no other way is sought
constexpr float reluctance = 1.08f;      // to turn: by so much another way must be faster
constexpr std::array turns_rad = {0.3f, 0.6f, 1.0f, 1.5f};  // radians from the aim
constexpr float widest_turn = 0.7f;                         // of who is not blocked
constexpr float blocked_gain = 0.5f;                        // of getting on at all, for who is

/// The fraction of a change of velocity that somebody makes within a step: who walks as fast as they like
/// goes on for a while as they do, who is slowed down to half of that or less turns to any gap at once.
float agility(float speed, float free_speed, float relaxation_s, float step_s) {
  const float inertia = std::clamp(2.0f * speed / free_speed - 1.0f, 0.0f, 1.0f);
  return inertia * relaxation_s > 0.0f ? 1.0f - std::exp(-step_s / (inertia * relaxation_s)) : 1.0f;
}

/// Half the breadth that somebody needs who has been blocked for so long: people turn their shoulders to
/// squeeze through, which breaks arches before doors.
float slim_radius(float radius_m, float blocked_s) {
  const float turned = std::clamp((blocked_s - squeezes_after_s) / squeezing_s, 0.0f, 1.0f);
  return radius_m * (1.0f - shoulders_turned * turned);
}

glm::vec2 turned_right(glm::vec2 v, float angle) {
  const float c = std::cos(angle), s = std::sin(angle);
  return {c * v.x + s * v.y, c * v.y - s * v.x};
}

template <class T>
void remove_from(std::vector<T>& values, std::size_t index) {
  values[index] = values.back();
  values.pop_back();
}

}  // namespace

std::size_t Walkers::add(glm::vec2 where, float ground_m, float radius, float speed) {
  position.push_back(where), velocity.emplace_back(0.0f), aim.emplace_back(0.0f);
  height_m.push_back(ground_m), radius_m.push_back(radius), free_speed.push_back(speed);
  blocked_s.push_back(0.0f);
  return size() - 1;
}

void Walkers::remove(std::size_t index) {
  remove_from(position, index), remove_from(velocity, index), remove_from(aim, index);
  remove_from(height_m, index), remove_from(radius_m, index), remove_from(free_speed, index);
  remove_from(blocked_s, index);
}

void Steering::sort(const Walkers& walkers) {
  const std::size_t count = walkers.size();
  glm::vec2 low = walkers.position[0], high = low;
  for (const glm::vec2 p : walkers.position) low = glm::min(low, p), high = glm::max(high, p);
  const glm::vec2 extent = high - low;
  cell_m_ = std::max(near_cell_m, std::max(extent.x, extent.y) / float(max_cells_per_side));
  corner_ = low;
  size_ = glm::ivec2(extent / cell_m_) + 1;
  starts_.assign(std::size_t(size_.x) * std::size_t(size_.y) + 1, 0);
  cells_.resize(count), sorted_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const glm::ivec2 cell((walkers.position[i] - corner_) / cell_m_);
    cells_[i] = std::uint32_t(cell.y * size_.x + cell.x);
    ++starts_[cells_[i] + 1];
  }
  for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
  for (std::size_t i = 0; i < count; ++i)
    sorted_[starts_[cells_[i]]++] = {walkers.position[i], walkers.velocity[i], walkers.aim[i],
                                     walkers.height_m[i], walkers.radius_m[i], std::uint32_t(i)};
  // Each start now is that of the next cell.
  for (std::size_t c = starts_.size() - 1; c > 0; --c) starts_[c] = starts_[c - 1];
  starts_[0] = 0;
}

Steering::Around Steering::look_around(std::size_t number) const {
  const Sorted& self = sorted_[number];
  std::array<Near, max_neighbours> found;
  const glm::ivec2 cell((self.position - corner_) / cell_m_);
  int count = 0;
  float reach_2 = reach_m * reach_m;
  const auto look = [&](int y, int from_x, int to_x) {
    if (y < 0 || y >= size_.y) return;
    from_x = std::max(from_x, 0), to_x = std::min(to_x, size_.x - 1);
    if (from_x > to_x) return;
    const std::uint32_t first = starts_[std::size_t(y * size_.x + from_x)],
                        last = starts_[std::size_t(y * size_.x + to_x) + 1];
    for (std::uint32_t i = first; i < last; ++i) {
      const glm::vec2 to = sorted_[i].position - self.position;
      const float distance_2 = glm::dot(to, to);
      if (distance_2 >= reach_2 || i == number || std::abs(sorted_[i].height_m - self.height_m) > storey_m)
        continue;
      int at = count < max_neighbours ? count++ : max_neighbours - 1;
      for (; at > 0 && found[at - 1].distance_2 > distance_2; --at) found[at] = found[at - 1];
      found[at] = {i, distance_2};
      if (count == max_neighbours) reach_2 = found[max_neighbours - 1].distance_2;
    }
  };
  for (int y = cell.y - 1; y <= cell.y + 1; ++y) look(y, cell.x - 1, cell.x + 1);
  if (reach_2 > cell_m_ * cell_m_) {  // else nobody nearer is farther out
    look(cell.y - 2, cell.x - 2, cell.x + 2), look(cell.y + 2, cell.x - 2, cell.x + 2);
    for (int y = cell.y - 1; y <= cell.y + 1; ++y)
      look(y, cell.x - 2, cell.x - 2), look(y, cell.x + 2, cell.x + 2);
  }
  Around around;
  around.count = count;
  around.x.fill(-1.0f), around.y.fill(0.0f), around.bodies.fill(-1.0f), around.room.fill(0.0f);
  for (std::size_t n = 0; n < std::size_t(count); ++n) {
    const Sorted& other = sorted_[found[n].index];
    const glm::vec2 to = other.position - self.position;
    around.x[n] = to.x, around.y[n] = to.y;
    around.bodies[n] = self.radius_m + other.radius_m;
    const bool goes_along = glm::dot(self.aim, other.aim) > same_way;
    const float body = goes_along ? rules_.headway_stride : rules_.headway_body;
    around.room[n] = std::max(std::sqrt(found[n].distance_2) - body * around.bodies[n], 0.0f);
    around.index[n] = found[n].index;
    // Of two who are in each other's way one goes first.
    const float before_it = -glm::dot(to, other.aim),
                beside_it = std::abs(to.x * other.aim.y - to.y * other.aim.x);
    const bool blocks_it = before_it > 0.0f && beside_it < rules_.headway_width * around.bodies[n];
    if (blocks_it && self.index < other.index) around.room[n] = free_way_m;
  }
  return around;
}

float Steering::speed_along(glm::vec2 way, float free_speed, const Around& around) const {
  // Numbers of at least zero are ordered as their bits are, and a minimum of whole numbers is a vector
  // instruction.
  constexpr std::int32_t free_way = std::bit_cast<std::int32_t>(free_way_m);
  std::int32_t least = free_way;
  for (std::size_t n = 0; n < Around::lanes; ++n) {
    const float ahead = around.x[n] * way.x + around.y[n] * way.y;
    const float beside = std::abs(around.x[n] * way.y - around.y[n] * way.x);
    const bool blocks = (ahead > 0.0f) & (beside < rules_.headway_width * around.bodies[n]);
    least = std::min(least, blocks ? std::bit_cast<std::int32_t>(around.room[n]) : free_way);
  }
  if (least == free_way) return free_speed;
  const float x = std::bit_cast<float>(least) / (free_speed * rules_.headway_s), x_2 = x * x;
  return free_speed * x / std::sqrt(std::sqrt(1.0f + x_2 * x_2));
}

glm::vec2 Steering::wanted_velocity(const Walkers& walkers, std::size_t number, const Around& around) const {
  const Sorted& self = sorted_[number];
  const glm::vec2 aim = walkers.aim[self.index];
  if (aim == glm::vec2(0.0f)) return aim;
  const float free_speed = walkers.free_speed[self.index];
  float speed = speed_along(aim, free_speed, around);
  if (speed > content * free_speed) return speed * aim;
  // The way on which one gets ahead fastest. The right side, turned to first, is taken where both are alike;
  // sides change in time for who is blocked.
  const float blocked_s = walkers.blocked_s[self.index];
  const bool is_blocked = blocked_s > patience_s;
  const float first_side = is_blocked && std::fmod(blocked_s, 4.0f) > 2.0f ? -1.0f : 1.0f;
  glm::vec2 best = speed * aim;
  float progress = speed * reluctance;
  for (const float turn : turns_rad) {
    if (turn > widest_turn && !is_blocked) break;
    for (const float side : {first_side, -first_side}) {
      const glm::vec2 way = turned_right(aim, side * turn);
      speed = speed_along(way, free_speed, around);
      const float along = speed * std::cos(turn) + (is_blocked ? blocked_gain * speed : 0.0f);
      if (along <= progress) continue;
      progress = along, best = speed * way;
    }
  }
  return best;
}

glm::vec2 Steering::steered(const Walkers& walkers, std::size_t number, const Walls& walls,
                            std::span<const MovingBody> bodies, const Around& around, float step_s) const {
  const Sorted& self = sorted_[number];
  std::array<VelocityHalfPlane, max_walls + std::size_t(max_neighbours) + max_bodies> planes;
  std::size_t used = 0;
  const float wall_reach = rules_.wall_horizon_s * walkers.free_speed[self.index] + 0.1f;
  for (const std::uint32_t w : walls.near(self.position)) {
    const Wall& wall = walls.all()[w];
    if (self.height_m < wall.bottom_m - 0.1f || self.height_m > wall.top_m) continue;
    const std::optional<WallContact> contact = contact_with(wall, self.position);
    if (!contact || contact->distance_m > wall_reach || contact->distance_m < -max_behind_m) continue;
    planes[used++] = clear_of_wall(contact->inward, contact->distance_m, rules_.wall_horizon_s, step_s);
    if (used == max_walls) break;
  }
  const std::size_t hard = used;
  std::array<std::pair<float, const MovingBody*>, max_bodies> near_bodies;  // nearest first
  std::size_t body_count = 0;
  for (const MovingBody& body : bodies) {
    if (self.height_m < body.bottom_m || self.height_m > body.top_m) continue;
    const float away_m =
        glm::distance(nearest_on_segment(body.a, body.b, self.position), self.position) - body.radius_m;
    if (away_m > body_reach_m || (body_count == max_bodies && away_m >= near_bodies.back().first)) continue;
    std::size_t at = body_count < max_bodies ? body_count++ : max_bodies - 1;
    for (; at > 0 && near_bodies[at - 1].first > away_m; --at) near_bodies[at] = near_bodies[at - 1];
    near_bodies[at] = {away_m, &body};
  }
  for (std::size_t b = 0; b < body_count; ++b) {
    const MovingBody& body = *near_bodies[b].second;
    const glm::vec2 to = nearest_on_segment(body.a, body.b, self.position) - self.position;
    planes[used++] = clear_of_disc({to, self.velocity - body.velocity, self.radius_m + body.radius_m},
                                   self.velocity, 2.0f * rules_.horizon_s, step_s, 1.0f);
  }
  const glm::vec2 wanted = wanted_velocity(walkers, number, around);
  for (std::size_t n = 0; n < std::size_t(around.count); ++n) {
    const Sorted& other = sorted_[around.index[n]];
    const bool stands = walkers.aim[other.index] == glm::vec2(0.0f);
    const bool goes_along = !stands && glm::dot(walkers.aim[other.index], walkers.aim[self.index]) > 0.5f;
    // Who stands is walked round.
    const float share = stands ? 1.0f : walkers.aim[self.index] == glm::vec2(0.0f) ? 0.0f : 0.5f;
    planes[used++] = clear_of_disc(
        {{around.x[n], around.y[n]}, self.velocity - other.velocity, slim_[self.index] + slim_[other.index]},
        self.velocity, goes_along ? along_horizon_s : rules_.horizon_s, step_s, share);
  }
  const float free_speed = walkers.free_speed[self.index];
  // Who was pushed does not go on as fast as that.
  const float own_speed = std::min(glm::length(self.velocity), free_speed);
  const glm::vec2 preferred =
      wanted == glm::vec2(0.0f)
          ? wanted
          : self.velocity +
                agility(own_speed, free_speed, rules_.relaxation_s, step_s) * (wanted - self.velocity);
  glm::vec2 best = nearest_velocity({planes.data(), used}, hard, preferred, std::max(free_speed, own_speed));
  // Who slides along others keeps the distance to the person whom he comes behind.
  if (const float speed = glm::length(best); speed > 0.0f && wanted != glm::vec2(0.0f)) {
    const float possible = speed_along(best / speed, std::max(free_speed, speed), around);
    if (possible < speed) best *= possible / speed;
  }
  const glm::vec2 change = best - self.velocity;
  const float most = rules_.max_acceleration * step_s, size = glm::length(change);
  return size > most ? self.velocity + change * (most / size) : best;
}

void Steering::separate(Walkers& walkers, const Walls& walls, std::span<const MovingBody> bodies) {
  for (int round = 0; round < separations; ++round) {
    for (std::size_t s = 0; s < sorted_.size(); ++s) {
      const std::uint32_t i = sorted_[s].index;
      for (int n = 0; n < neighbour_count_[s]; ++n) {
        const std::uint32_t j = sorted_[neighbours_[s * max_neighbours + std::size_t(n)]].index;
        const glm::vec2 apart = walkers.position[i] - walkers.position[j];
        const float touching = slim_[i] + slim_[j], distance_2 = glm::dot(apart, apart);
        if (distance_2 >= touching * touching) continue;
        const float distance = std::sqrt(distance_2);
        const glm::vec2 away = distance > 1e-4f ? apart / distance : glm::vec2(i < j ? 1.0f : -1.0f, 0.0f);
        const glm::vec2 push = 0.5f * (touching - distance) * away;
        walkers.position[i] += push, walkers.position[j] -= push;
      }
    }
    for (const Sorted& self : sorted_) {
      const std::size_t i = self.index;
      glm::vec2& p = walkers.position[i];
      for (const MovingBody& body : bodies) {
        const glm::vec2 from = p - nearest_on_segment(body.a, body.b, p);
        const float least = walkers.radius_m[i] + body.radius_m, distance = glm::length(from);
        if (distance < least && distance > 1e-4f && walkers.height_m[i] >= body.bottom_m &&
            walkers.height_m[i] <= body.top_m)
          p += from * ((least - distance) / distance);
      }
      for (const std::uint32_t w : walls.near(p)) {
        const Wall& wall = walls.all()[w];
        if (walkers.height_m[i] < wall.bottom_m - 0.1f || walkers.height_m[i] > wall.top_m) continue;
        const std::optional<WallContact> contact = contact_with(wall, p);
        if (!contact || contact->distance_m >= 0.0f) continue;
        // However far others have pushed: who stood before the wall when the step began stays there.
        const float before_m = glm::dot(self.position - wall.a, contact->inward);
        if (before_m > -max_behind_m) p -= contact->distance_m * contact->inward;
      }
    }
  }
}

void Steering::step(Walkers& walkers, const Walls& walls, std::span<const MovingBody> bodies, float step_s) {
  if (walkers.size() == 0) return;
  sort(walkers);
  const std::size_t count = walkers.size();
  slim_.resize(count);
  for (std::size_t i = 0; i < count; ++i) slim_[i] = slim_radius(walkers.radius_m[i], walkers.blocked_s[i]);
  neighbours_.resize(count * max_neighbours), neighbour_count_.resize(count), steered_.resize(count);
  for (std::size_t s = 0; s < count; ++s) {
    const Around around = look_around(s);
    neighbour_count_[s] = std::uint8_t(around.count);
    std::copy_n(around.index.begin(), around.count, neighbours_.begin() + std::ptrdiff_t(s * max_neighbours));
    steered_[s] = steered(walkers, s, walls, bodies, around, step_s);
  }
  for (std::size_t s = 0; s < count; ++s) walkers.position[sorted_[s].index] += step_s * steered_[s];
  separate(walkers, walls, bodies);
  for (std::size_t s = 0; s < count; ++s) {
    const std::uint32_t i = sorted_[s].index;
    walkers.velocity[i] = (walkers.position[i] - sorted_[s].position) / step_s;
    const bool wants = walkers.aim[i] != glm::vec2(0.0f);
    const bool moves = glm::length(walkers.velocity[i]) > slow * walkers.free_speed[i];
    walkers.blocked_s[i] = wants && !moves ? walkers.blocked_s[i] + step_s : 0.0f;
  }
}

}  // namespace parvis::crowd
