#include "life/sound/late_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "life/propagation/scene_site.h"

namespace parvis::sound {
namespace {

constexpr double wave_speed_m_s = 340.0, farthest_m = 150.0;
constexpr int headings = 36, slopes = 4, max_orders = 24;

}  // namespace

Enclosure enclosure_about(const propagation::Site& site, const glm::dvec3& place, int first_order,
                          const Octaves& air_db_per_m) {
  const double ground = site.terrain().ground_z(glm::dvec2(place));
  double area_m2 = 0.0, height_m = 0.0;
  int walls = 0;
  Octaves late_m{}, arriving{};  // what rays still travel, and how much of them arrives there
  for (int heading = 0; heading < headings; ++heading)
    for (int slope = 0; slope < slopes; ++slope) {
      const double angle = 2.0 * std::numbers::pi * (heading + 0.5) / headings;
      // Even over the sphere: sines of elevation are even; the ground mirrors those that go down.
      const double sine = (slope + 0.5) / slopes, cosine = std::sqrt(1.0 - sine * sine);
      glm::dvec2 from(place), along(std::cos(angle), std::sin(angle));
      double travelled_m = 0.0, z = place.z, kept = 1.0;
      int last = -1;
      for (int order = 0; order < max_orders; ++order) {
        const auto hit = site.reflecting_wall(from, from + along * farthest_m, last);
        const double plan_m = hit ? hit->distance_m : farthest_m;
        if (order == 0) area_m2 += std::numbers::pi * plan_m * plan_m / (headings * slopes);
        z += plan_m * sine / cosine;
        const double leg_m = plan_m / cosine;
        // A ray that leaves over the roof has stayed in the place for a part of its leg.
        const double within_m =
            hit && z <= hit->top_z ? leg_m
            : hit ? leg_m * std::clamp(1.0 - (z - hit->top_z) / (plan_m * sine / cosine), 0.0, 1.0)
                  : 0.0;
        if (order > first_order)
          for (std::size_t band = 0; band < octaves; ++band) {
            const double energy = kept * propagation::energy(-air_db_per_m[band] * travelled_m);
            late_m[band] += energy * within_m;
            if (order == first_order + 1) arriving[band] += energy;
          }
        if (!hit) break;
        if (order == 0) height_m += std::max(hit->top_z - ground, 0.0), ++walls;
        if (z > hit->top_z) break;
        travelled_m += leg_m, kept *= 1.0 - propagation::facade_absorption;
        from += along * plan_m, along = site.turned_by(hit->wall, along), last = hit->wall;
      }
    }
  Enclosure result;
  if (walls == 0) return result;
  height_m /= walls;
  result.reach_m = std::sqrt(area_m2 / std::numbers::pi);
  for (std::size_t band = 0; band < octaves; ++band) {
    result.energy[band] = late_m[band] / (headings * slopes) / std::max(area_m2 * height_m, 1.0);
    result.decay_s[band] =
        arriving[band] > 0.0 ? std::max(late_m[band] / arriving[band] / wave_speed_m_s, 0.01) : 0.01;
  }
  return result;
}

const Octaves& LateField::advance(const Enclosure& enclosure, const Octaves& power, double step_s) {
  for (std::size_t band = 0; band < octaves; ++band) {
    const double follows = 1.0 - std::exp(-step_s / std::max(enclosure.decay_s[band], 0.01));
    energy_[band] += follows * (power[band] * enclosure.energy[band] - energy_[band]);
  }
  return energy_;
}

}  // namespace parvis::sound
