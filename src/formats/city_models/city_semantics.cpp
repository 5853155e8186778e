#include "formats/city_models/city_semantics.h"

#include <algorithm>
#include <cmath>

#include "formats/city_models/polygon_triangles.h"

namespace parvis::scene {
namespace {

constexpr double steep = 0.34;         // cosine of 70 degrees
constexpr double share_of_foot = 0.1;  // of a building's height, in which level surfaces are its ground

struct Heights {
  double low = 1e300, high = -1e300;

  void add(const CitySurface& surface) {
    for (const glm::dvec3& point : surface.rings.front())
      low = std::min(low, point.z), high = std::max(high, point.z);
  }
};

/// The z of a ring's unit normal; about its first point, for far coordinates would cost the normal its
/// digits.
double up_of(std::vector<glm::dvec3> ring) {
  const glm::dvec3 first = ring.front();
  for (glm::dvec3& point : ring) point -= first;
  const glm::dvec3 area = newell_normal(ring);
  return glm::length(area) > 0.0 ? area.z / glm::length(area) : 0.0;
}

const char* name_of(const CitySurface& surface, const Heights& building) {
  const double up = up_of(surface.rings.front());
  if (std::abs(up) <= steep) return "WallSurface";
  Heights own;
  own.add(surface);
  const bool is_at_foot = own.high <= building.low + share_of_foot * (building.high - building.low);
  const bool may_be_ground = !surface.is_of_solid || up < 0.0;
  if (is_at_foot && may_be_ground) return "GroundSurface";
  return surface.is_of_solid && up < 0.0 ? "OuterCeilingSurface" : "RoofSurface";
}

}  // namespace

void infer_semantics(std::vector<CitySurface>& surfaces) {
  const auto has_ring = [](const CitySurface& surface) {
    return !surface.rings.empty() && surface.rings.front().size() >= 3;
  };
  Heights building;
  for (const CitySurface& surface : surfaces)
    if (has_ring(surface)) building.add(surface);
  for (CitySurface& surface : surfaces)
    if (surface.semantics.empty() && has_ring(surface)) surface.semantics = name_of(surface, building);
}

}  // namespace parvis::scene
