#include "formats/city_models/city_semantics.h"

#include <algorithm>
#include <cmath>

#include "formats/city_models/polygon_triangles.h"

namespace parvis::scene {
namespace {

constexpr double steep = 0.34;         // cosine of 70 degrees
constexpr double share_of_foot = 0.1;  // of a building's height, in which level surfaces are its ground
// Of the area of a building whose surfaces all have one kind: what sills, dormers and chimneys stay below.
constexpr double max_level_walls = 0.1, max_steep_roofs = 1.0 / 3.0;

struct Heights {
  double low = 1e300, high = -1e300;

  void add(const CitySurface& surface) {
    for (const glm::dvec3& point : surface.rings.front())
      low = std::min(low, point.z), high = std::max(high, point.z);
  }
};

/// A ring's normal as long as its area; about its first point, for far coordinates would cost the normal its
/// digits.
glm::dvec3 area_of(std::vector<glm::dvec3> ring) {
  const glm::dvec3 first = ring.front();
  for (glm::dvec3& point : ring) point -= first;
  return newell_normal(ring);
}

/// The z of a ring's unit normal.
double up_of(const std::vector<glm::dvec3>& ring) {
  const glm::dvec3 area = area_of(ring);
  return glm::length(area) > 0.0 ? area.z / glm::length(area) : 0.0;
}

bool has_ring(const CitySurface& surface) {
  return !surface.rings.empty() && surface.rings.front().size() >= 3;
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

void drop_implausible_semantics(std::vector<CitySurface>& surfaces) {
  if (surfaces.size() < 2) return;
  const std::string kind = surfaces.front().semantics;
  double steep_m2 = 0.0, all_m2 = 0.0;
  for (const CitySurface& surface : surfaces) {
    if (surface.semantics != kind) return;
    if (!has_ring(surface)) continue;
    const glm::dvec3 area = area_of(surface.rings.front());
    all_m2 += glm::length(area);
    if (std::abs(area.z) <= steep * glm::length(area)) steep_m2 += glm::length(area);
  }
  const bool is_implausible = kind == "WallSurface" ? all_m2 - steep_m2 > max_level_walls * all_m2
                                                    : (kind == "RoofSurface" || kind == "GroundSurface") &&
                                                          steep_m2 > max_steep_roofs * all_m2;
  if (is_implausible)
    for (CitySurface& surface : surfaces) surface.semantics.clear();
}

void infer_semantics(std::vector<CitySurface>& surfaces) {
  Heights building;
  for (const CitySurface& surface : surfaces)
    if (has_ring(surface)) building.add(surface);
  for (CitySurface& surface : surfaces)
    if (surface.semantics.empty() && has_ring(surface)) surface.semantics = name_of(surface, building);
}

}  // namespace parvis::scene
