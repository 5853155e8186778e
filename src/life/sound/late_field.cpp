#include "life/sound/late_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "life/propagation/scene_site.h"

namespace parvis::sound {
namespace {

constexpr double wave_speed_m_s = 340.0, farthest_m = 150.0;
constexpr int headings = 36, slopes = 4, max_orders = 24;

/// The ways that rays still travel beyond the reflections of the paths, and how much of them arrives there.
struct LateRays {
  const Octaves& air_db_per_m;
  Octaves late_m{}, arriving{};

  void add(double kept, double travelled_m, double within_m, bool is_first) {
    for (std::size_t band = 0; band < octaves; ++band) {
      const double energy = kept * propagation::energy(-air_db_per_m[band] * travelled_m);
      late_m[band] += energy * within_m;
      if (is_first) arriving[band] += energy;
    }
  }
  Enclosure enclosure(double area_m2, double volume_m3) const {
    Enclosure result{.reach_m = std::sqrt(area_m2 / std::numbers::pi)};
    for (std::size_t band = 0; band < octaves; ++band) {
      result.energy[band] = late_m[band] / (headings * slopes) / std::max(volume_m3, 1.0);
      result.decay_s[band] =
          arriving[band] > 0.0 ? std::max(late_m[band] / arriving[band] / wave_speed_m_s, 0.01) : 0.01;
    }
    return result;
  }
};

/// Calls trace(plan direction, sine of elevation, cosine) for rays that are even over the sphere; the ground
/// mirrors those that go down.
template <class Trace>
void for_each_ray(const Trace& trace) {
  for (int heading = 0; heading < headings; ++heading)
    for (int slope = 0; slope < slopes; ++slope) {
      const double angle = 2.0 * std::numbers::pi * (heading + 0.5) / headings, sine = (slope + 0.5) / slopes;
      trace(glm::dvec2(std::cos(angle), std::sin(angle)), sine, std::sqrt(1.0 - sine * sine));
    }
}

/// How far in plan a ray goes, of a way, until it rises through a ceiling.
double to_ceiling_m(const propagation::Terrain& terrain, const glm::dvec3& from, glm::dvec2 along,
                    double rise, double way_m) {
  constexpr double step_m = 0.5;
  for (double at_m = 0.0; at_m < way_m; at_m += step_m) {
    const std::optional<double> ceiling = terrain.ceiling_z(glm::dvec2(from) + at_m * along);
    const double z = from.z + rise * at_m;
    if (ceiling && z <= *ceiling && z + rise * step_m > *ceiling)
      return std::min(at_m + (*ceiling - z) / rise, way_m);
  }
  return way_m;
}

}  // namespace

Enclosure enclosure_about(const propagation::Site& site, const glm::dvec3& place, int first_order,
                          const Octaves& air_db_per_m) {
  const double ground = site.terrain().ground_z(glm::dvec2(place));
  double area_m2 = 0.0, height_m = 0.0;
  int walls = 0;
  const bool has_ceilings =
      std::ranges::any_of(site.walls(), [](const propagation::Wall& wall) { return wall.bottom > -1e8; });
  LateRays rays{air_db_per_m};
  for_each_ray([&](glm::dvec2 along, double sine, double cosine) {
    glm::dvec3 from = place;
    double travelled_m = 0.0, kept = 1.0;
    int last = -1;
    for (int order = 0; order < max_orders; ++order) {
      const double rise = sine / cosine;
      const auto hit = site.reflecting_wall(from, from + farthest_m * glm::dvec3(along, rise), last);
      const double plan_m = hit ? hit->distance_m : farthest_m,
                   free_m = has_ceilings ? to_ceiling_m(site.terrain(), from, along, rise, plan_m) : plan_m;
      if (order == 0) area_m2 += std::numbers::pi * plan_m * plan_m / (headings * slopes);
      const glm::dvec3 to = from + plan_m * glm::dvec3(along, rise);
      const double leg_m = plan_m / cosine;
      // A ray that leaves over the roof, or is lost at a ceiling, has stayed in the place for a part of its
      // leg.
      const double within_m = free_m < plan_m ? free_m / cosine
                              : !hit          ? 0.0
                              : to.z <= hit->top_z
                                  ? leg_m
                                  : leg_m * std::clamp((hit->top_z - from.z) / (to.z - from.z), 0.0, 1.0);
      if (order > first_order) rays.add(kept, travelled_m, within_m, order == first_order + 1);
      if (!hit) break;
      if (order == 0) height_m += std::max(hit->top_z - ground, 0.0), ++walls;
      if (free_m < plan_m || to.z > hit->top_z) break;
      travelled_m += leg_m, kept *= 1.0 - propagation::facade_absorption;
      from = to, along = site.turned_by(hit->wall, along), last = hit->wall;
    }
  });
  return walls == 0 ? Enclosure{} : rays.enclosure(area_m2, area_m2 * height_m / walls);
}

Enclosure covered_about(const propagation::Site& site, const glm::dvec3& place, int first_order,
                        const Octaves& air_db_per_m) {
  constexpr double step_m = 0.5;
  constexpr int max_steps = 400;
  const propagation::Terrain& terrain = site.terrain();
  double area_m2 = 0.0, volume_m3 = 0.0;
  LateRays rays{air_db_per_m};
  for_each_ray([&](glm::dvec2 along, double sine, double cosine) {
    glm::dvec2 at(place);
    double z = place.z, rise = sine / cosine, travelled_m = 0.0, kept = 1.0, to_wall_m = 0.0;
    std::optional<propagation::Site::WallHit> wall;
    int walls = 0, ceilings = 0;
    bool is_late = false;
    const auto seek_wall = [&] {
      // Walls that somebody can walk below let all rays through: what opens the arcade is its own field.
      wall = site.reflecting_wall({at, place.z}, {at + along * farthest_m, place.z}, wall ? wall->wall : -1);
      to_wall_m = wall ? wall->distance_m : farthest_m;
    };
    seek_wall();
    for (int i = 0; i < max_steps; ++i) {
      const std::optional<double> ceiling = terrain.ceiling_z(at);
      if (!ceiling || z > *ceiling) break;  // it has left through an opening
      const double ground = terrain.ground_z(at), leg_m = std::min(step_m, to_wall_m);
      if (walls > first_order || ceilings > 0)
        rays.add(kept, travelled_m, leg_m / cosine, !std::exchange(is_late, true));
      if (walls == 0) {  // a ring of the plan that is seen from the place
        const double from_m = glm::distance(at, glm::dvec2(place)), to_m = from_m + leg_m;
        const double ring_m2 = std::numbers::pi * (to_m * to_m - from_m * from_m) / (headings * slopes);
        area_m2 += ring_m2, volume_m3 += ring_m2 * std::max(*ceiling - ground, 0.0);
      }
      at += along * leg_m, z += rise * leg_m, travelled_m += leg_m / cosine, to_wall_m -= leg_m;
      if (z > *ceiling) {
        z = 2.0 * *ceiling - z, rise = -rise, kept *= 1.0 - propagation::facade_absorption, ++ceilings;
      } else if (z < ground) {
        z = 2.0 * ground - z, rise = -rise;
      }
      if (to_wall_m > 1e-9) continue;
      if (!wall) break;
      along = site.turned_by(wall->wall, along), kept *= 1.0 - propagation::facade_absorption, ++walls;
      seek_wall();
    }
  });
  return area_m2 <= 0.0 ? Enclosure{} : rays.enclosure(area_m2, volume_m3);
}

const Octaves& LateField::advance(const Enclosure& enclosure, const Octaves& power, double step_s) {
  for (std::size_t band = 0; band < octaves; ++band) {
    const double follows = 1.0 - std::exp(-step_s / std::max(enclosure.decay_s[band], 0.01));
    energy_[band] += follows * (power[band] * enclosure.energy[band] - energy_[band]);
  }
  return energy_;
}

}  // namespace parvis::sound
