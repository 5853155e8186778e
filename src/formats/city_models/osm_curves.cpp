#include "formats/city_models/osm_curves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "formats/city_models/polygon_triangles.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

constexpr std::size_t min_corners = 12;  // of the outline of a cone: they turn by 30 degrees
constexpr double max_facet_m = 6.0;      // of a wall: wider ones are seen to be flat
const double min_cos = std::cos(glm::radians(30.0));
constexpr double same_curve_point_m = 1e-3;
constexpr std::size_t max_at_point = 500;  // facets: of more, none is seen

std::array<long, 3> place_of(const dvec3& point) {
  const dvec3 at = point / same_curve_point_m;
  return {std::lround(at.x), std::lround(at.y), std::lround(at.z)};
}

/// Newell's normal about the first corner: far coordinates would cost it its digits.
dvec3 area_of(OsmFacet facet) {
  const dvec3 first = facet.front();
  for (dvec3& corner : facet) corner -= first;
  return newell_normal(facet);
}

}  // namespace

bool is_curved(const OsmRoof& roof) {
  if (roof.skeleton) return false;
  if (roof.shape == "dome" || roof.shape == "onion" || roof.shape == "round") return true;
  return roof.shape == "pyramidal" && roof.corners.size() >= min_corners;
}

bool is_curved(dvec2 from, dvec2 to) { return glm::distance(from, to) <= max_facet_m; }

std::vector<std::vector<glm::vec3>> curved_normals(const std::vector<OsmFacet>& facets) {
  std::vector<dvec3> areas, flat;
  areas.reserve(facets.size()), flat.reserve(facets.size());
  std::map<std::array<long, 3>, std::vector<std::size_t>> at_point;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    areas.push_back(area_of(facets[i]));
    const double length = glm::length(areas.back());
    flat.push_back(length > 0.0 ? areas.back() / length : dvec3(0.0, 0.0, 1.0));
    for (const dvec3& corner : facets[i]) at_point[place_of(corner)].push_back(i);
  }
  std::vector<std::vector<glm::vec3>> normals(facets.size());
  for (std::size_t i = 0; i < facets.size(); ++i)
    for (const dvec3& corner : facets[i]) {
      const std::vector<std::size_t>& here = at_point.at(place_of(corner));
      dvec3 sum = areas[i];
      for (const std::size_t other : here)
        if (here.size() <= max_at_point && other != i && glm::dot(flat[i], flat[other]) >= min_cos)
          sum += areas[other];
      normals[i].emplace_back(glm::length(sum) > 0.0 ? glm::normalize(sum) : flat[i]);
    }
  return normals;
}

}  // namespace parvis::scene
