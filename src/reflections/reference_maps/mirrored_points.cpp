#include "reflections/reference_maps/mirrored_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/random.h"
#include "reflections/reference_maps/driving_area.h"
#include "reflections/reference_maps/validity.h"

namespace parvis::reference_maps {
namespace {

constexpr float bodywork_height_m = 1.0f;
constexpr float steepest_rise = -0.35f;     // of rays, downward: sine of 20 degrees
constexpr float vehicles_apart_m = 0.5f;    // of places that vehicles are drawn from
constexpr float beside_lane_m = 1.0f;       // they do not all keep to its middle
constexpr float grazing_cosine = 0.05f;     // flatter surfaces are not measured: cells have no slopes
constexpr float valid = 0.5f;               // from here on a map keeps most of its weight
constexpr std::size_t tries_per_point = 8;  // a place that is mostly sky gives fewer points

/// Normal of the cell's side or top that a ray has hit.
glm::vec3 normal_of_hit(const HeightPyramid& heights, const HeightHit& hit, glm::vec3 at,
                        glm::vec3 direction) {
  if (hit.kind == HitKind::top) return {0, 0, 1};
  const glm::vec2 in_cells = (glm::vec2(at) - heights.origin()) / heights.cell_m();
  const glm::vec2 off_side = glm::abs(in_cells - glm::round(in_cells));
  return off_side.x < off_side.y ? glm::vec3(direction.x > 0 ? -1 : 1, 0, 0)
                                 : glm::vec3(0, direction.y > 0 ? -1 : 1, 0);
}

}  // namespace

std::vector<MirroredPoint> mirrored_points(const scene::Scene& scene, const HeightPyramid& heights,
                                           std::size_t count, std::uint64_t seed) {
  const std::vector<glm::vec3> vehicles = driving_places(scene, heights, vehicles_apart_m);
  Random random(seed);
  std::vector<MirroredPoint> points;
  for (std::size_t i = 0; i < tries_per_point * count && points.size() < count; ++i) {
    const glm::vec3 foot = vehicles[std::size_t(random.index(int(vehicles.size())))];
    const glm::vec3 vehicle =
        foot + glm::vec3(random.uniform(-beside_lane_m, beside_lane_m),
                         random.uniform(-beside_lane_m, beside_lane_m), bodywork_height_m);
    const float rise = random.uniform(steepest_rise, 1.0f);
    const float turn = random.uniform(0.0f, 2.0f * std::numbers::pi_v<float>);
    const float across = std::sqrt(1.0f - rise * rise);
    const glm::vec3 direction(across * std::cos(turn), across * std::sin(turn), rise);
    const HeightHit hit = heights.walk_by_levels(vehicle, direction, mirror_reach_m);
    if (hit.kind == HitKind::nothing) continue;
    MirroredPoint point{vehicle + hit.distance_m * direction, {}, 0.0f};
    point.normal = normal_of_hit(heights, hit, point.position, direction);
    point.vehicle_footprint = footprint(vehicle, point);
    points.push_back(point);
  }
  return points;
}

float footprint(glm::vec3 place, const MirroredPoint& point) {
  const glm::vec3 to_place = place - point.position;
  const float distance_m = std::max(glm::length(to_place), 1e-3f);
  const float cosine = std::max(glm::dot(to_place, point.normal) / distance_m, grazing_cosine);
  return distance_m / std::sqrt(cosine);
}

bool shows(const HeightPyramid& heights, glm::vec3 place, const MirroredPoint& point, float sharpness) {
  if (footprint(place, point) > sharpness * point.vehicle_footprint) return false;
  const glm::vec3 to_point = point.position - place;
  const float distance_m = std::max(glm::length(to_point), 1e-3f);
  const HeightHit seen = heights.walk_by_levels(place, to_point / distance_m, distance_m);
  return validity(seen.distance_m, distance_m, heights.cell_m()) >= valid;
}

std::vector<float> coverage(const HeightPyramid& heights, const std::vector<glm::vec3>& places,
                            const std::vector<MirroredPoint>& points, float sharpness) {
  std::vector<std::size_t> first_shown(points.size());
  parallel_for(
      points.size(),
      [&](std::size_t i) {
        while (first_shown[i] < places.size() &&
               !shows(heights, places[first_shown[i]], points[i], sharpness))
          ++first_shown[i];
      },
      64);
  std::vector<std::size_t> newly_shown(places.size() + 1);
  for (const std::size_t first : first_shown) ++newly_shown[first];
  std::vector<float> shares;
  std::size_t shown = 0;
  for (std::size_t n = 0; n < places.size(); ++n) {
    shown += newly_shown[n];
    shares.push_back(points.empty() ? 1.0f : float(double(shown) / double(points.size())));
  }
  return shares;
}

}  // namespace parvis::reference_maps
