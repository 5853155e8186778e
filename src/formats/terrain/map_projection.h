// Maps on which models meet: from degrees on the earth (WGS 84) to metres, through PROJ.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>

namespace parvis::scene {

class ProjectedMap;

/// The limit of UTM, north and south.
inline constexpr double max_latitude_deg = 84.0;

/// A projected coordinate system, east first, in metres whatever its own unit is.
class MapProjection {
 public:
  /// The zone of the universal transverse Mercator projection for a place (degrees: east, north): within it
  /// scale is within 0.04 %, and north within 3 degrees of the meridian. Where PROJ cannot be loaded
  /// (projections_known) no place is on it.
  static MapProjection utm(glm::dvec2 place_deg);
  /// The system of a name ("EPSG:25832") or description (WKT) that PROJ reads. Nothing where it knows none
  /// that is projected.
  static std::optional<MapProjection> of(const std::string& system);

  /// The text that `of` reads as this system.
  const std::string& system() const { return system_; }
  /// Easting and northing in metres; not finite where the place lies beyond the map.
  glm::dvec2 operator()(glm::dvec2 place_deg) const;
  /// The place (degrees: east, north) of a point on the map in metres; not finite beyond the map.
  glm::dvec2 degrees(glm::dvec2 on_map_m) const;
  /// Where true north lies at a place, degrees clockwise from the map's own north.
  double true_north_deg(glm::dvec2 place_deg) const;

 private:
  MapProjection(std::string system, std::shared_ptr<const ProjectedMap> map)
      : system_(std::move(system)), map_(std::move(map)) {}

  std::string system_;
  std::shared_ptr<const ProjectedMap> map_;  ///< null where PROJ cannot be loaded
};

}  // namespace parvis::scene
