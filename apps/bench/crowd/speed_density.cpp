// Speeds over densities in a periodic corridor, beside Weidmann 1993: people walk one way; who leaves at one
// end comes in at the other, and those near an end see those beyond it. Density and speed are those of the
// middle 2 x 2 m: each place of it counts with the inverse area of the Voronoi cell that it lies in (Steffen
// and Seyfried 2010), and with its person's speed.
#include <algorithm>
#include <cmath>

#include "bench/crowd/test_place.h"
#include "life/crowd/steering.h"

namespace parvis::bench {
namespace {

constexpr float length_m = 26.0f, width_m = 2.0f, wall_m = 0.15f, seen_m = 4.0f;
constexpr float field_from_m = 12.0f, field_to_m = 14.0f, cell_m = 0.1f;

float weidmann(float density) { return 1.34f * (1.0f - std::exp(-1.913f * (1.0f / density - 1.0f / 5.4f))); }

/// A step of everybody, with copies of those near the ends beyond the other end.
void step_periodic(crowd::Walkers& walkers, crowd::Steering& steering, const crowd::Walls& walls) {
  const std::size_t people = walkers.size();
  for (std::size_t i = 0; i < people; ++i) {
    const float x = walkers.position[i].x;
    const float beyond = x < seen_m ? length_m : x > length_m - seen_m ? -length_m : 0.0f;
    if (beyond == 0.0f) continue;
    const std::size_t copy = walkers.add(walkers.position[i] + glm::vec2(beyond, 0.0f), 0.0f,
                                         walkers.radius_m[i], walkers.free_speed[i]);
    walkers.velocity[copy] = walkers.velocity[i], walkers.aim[copy] = walkers.aim[i];
    walkers.blocked_s[copy] = walkers.blocked_s[i];
  }
  steering.step(walkers, walls, {}, crowd_test_step_s);
  while (walkers.size() > people) walkers.remove(walkers.size() - 1);
  for (glm::vec2& p : walkers.position) p.x -= length_m * std::floor(p.x / length_m);
}

/// Density and speed in the field now.
DensityPoint seen_in_field(const crowd::Walkers& walkers) {
  const auto columns = int(length_m / cell_m), rows = int(width_m / cell_m);
  std::vector<int> owner(std::size_t(columns) * std::size_t(rows));
  std::vector<float> area(walkers.size(), 0.0f);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) {
      const glm::vec2 place((float(x) + 0.5f) * cell_m, (float(y) + 0.5f) * cell_m);
      float nearest = 1e9f;
      int& mine = owner[std::size_t(y * columns + x)];
      for (std::size_t i = 0; i < walkers.size(); ++i) {
        glm::vec2 to = walkers.position[i] - place;
        to.x = std::remainder(to.x, length_m);
        if (const float d = glm::dot(to, to); d < nearest) nearest = d, mine = int(i);
      }
      area[std::size_t(mine)] += cell_m * cell_m;
    }
  DensityPoint sum;
  int places = 0;
  for (int y = 0; y < rows; ++y)
    for (int x = int(field_from_m / cell_m); x < int(field_to_m / cell_m); ++x, ++places) {
      const auto person = std::size_t(owner[std::size_t(y * columns + x)]);
      sum.density += 1.0f / area[person], sum.speed += walkers.velocity[person].x;
    }
  sum.density /= float(places), sum.speed /= float(places);
  return sum;
}

}  // namespace

float DensityPoint::error_percent() const { return 100.0f * std::abs(speed / weidmann(density) - 1.0f); }

std::vector<DensityPoint> speed_density(const crowd::SteeringRules& rules, float seconds) {
  const crowd::Walls walls({{{-10, wall_m}, {length_m + 10, wall_m}},
                            {{length_m + 10, width_m - wall_m}, {-10, width_m - wall_m}}},
                           1.2f);
  std::vector<DensityPoint> points;
  for (const float asked : {0.5f, 1.0f, 1.5f, 2.0f, 3.0f, 4.0f}) {
    crowd::Walkers walkers;
    crowd::Steering steering(rules);
    Random random(4);
    const int people = int(asked * length_m * width_m);
    for (int i = 0; i < people; ++i) {
      // Rows across the corridor, each person a little out of place.
      const int across = std::max(1, int(std::sqrt(asked) * width_m)), row = i / across;
      const float rows = std::ceil(float(people) / float(across));
      const glm::vec2 place(length_m * (float(row) + random.uniform(0.2f, 0.8f)) / rows,
                            wall_m + (width_m - 2.0f * wall_m) *
                                         (float(i % across) + random.uniform(0.3f, 0.7f)) / float(across));
      walkers.add(place, 0.0f, 0.19f, 1.34f);
      walkers.aim.back() = {1, 0};
    }
    DensityPoint sum{asked};
    int looks = 0;
    for (int s = 0; float(s) * crowd_test_step_s < 10.0f + seconds; ++s) {
      step_periodic(walkers, steering, walls);
      if (float(s) * crowd_test_step_s < 10.0f || s % 10 != 0) continue;
      const DensityPoint now = seen_in_field(walkers);
      sum.density += now.density, sum.speed += now.speed, ++looks;
    }
    sum.density /= float(looks), sum.speed /= float(looks);
    points.push_back(sum);
  }
  return points;
}

}  // namespace parvis::bench
