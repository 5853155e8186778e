#include <cmath>

#include "formats/ifc/ifc_georeference.h"
#include "formats/terrain/map_projection.h"

namespace parvis::scene {

IfcGeoreference on_map(IfcGeoreference place, const std::string& map) {
  if (place.map.empty() || map.empty() || map == place.map) return place;
  const std::optional<MapProjection> own = MapProjection::of(place.map), other = MapProjection::of(map);
  if (!own || !other) return place;
  const glm::dvec2 deg = own->degrees(place.origin), there = (*other)(deg);
  if (!std::isfinite(there.x + there.y)) return place;
  const double true_north_deg = other->true_north_deg(deg),
               turn = glm::radians(true_north_deg - place.true_north_deg);  // clockwise
  const glm::dvec2 x = place.x_axis;
  place.x_axis = {x.x * std::cos(turn) + x.y * std::sin(turn), x.y * std::cos(turn) - x.x * std::sin(turn)};
  place.origin = glm::dvec3(there, place.origin.z);
  place.map = map, place.true_north_deg = true_north_deg;
  return place;
}

}  // namespace parvis::scene
