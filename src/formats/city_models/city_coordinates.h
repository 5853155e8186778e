// From the coordinates of a city file to metres on a map: degrees, in either order of their axes, and feet.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "formats/terrain/map_projection.h"

namespace parvis::scene {

/// A file's statements about its coordinates, and their properties.
struct CoordinateClues {
  std::string system;  ///< as the file names it, "urn:ogc:def:crs:EPSG::7415"; may be empty
  glm::dvec3 low{std::numeric_limits<double>::max()};  ///< of the coordinates as they stand in the file
  glm::dvec3 high{-std::numeric_limits<double>::max()};
  /// Areas of roofs in plan: of all, and those that face up less those that face down if the first axis
  /// points east. In a file whose first axis points north its roofs seem to face down.
  double roofs = 0.0, roofs_up = 0.0;

  /// Volumes of bodies whose surfaces have no names, above their lowest points: of all, and those that are
  /// the right side out less those that are inside out if the first axis points east.
  double bodies = 0.0, bodies_right = 0.0;

  void add(const glm::dvec3& point);
  /// The outer ring of a roof, counterclockwise where it faces up in a file whose first axis points east.
  void add_roof(std::span<const glm::dvec3> ring);
  /// The rings of a body, outer ones counterclockwise seen from outside.
  void add_body(std::span<const std::vector<glm::dvec3>> rings);
};

/// Turns the coordinates of one file into metres.
class CityCoordinates {
 public:
  /// Coordinates in metres, east first, which stay as they are.
  CityCoordinates() = default;

  /// Degrees become metres on the map of their zone (formats/terrain/map_projection.h), on which maps of
  /// OpenStreetMap stand, too; feet become metres. Which of two degrees is the latitude follows from the
  /// coordinates where one is beyond 90, else from the system's name, unless all roofs would face down. A
  /// system that is not known and coordinates that are none of the system's are warnings, and read as metres,
  /// east first. Of projected systems whose northing stands first by definition many files have it second:
  /// roofs say so, else bodies, the area of the system, and how the file names it (a urn means the order of
  /// the definition). Where `map` is another system (formats/terrain/map_projection.h) all is laid on it.
  /// Errors: degrees that reach over more than a region.
  static Result<CityCoordinates> find(const CoordinateClues& clues, const std::filesystem::path& file,
                                      Errors& warnings, const std::string& map = {});

  /// Metres: east, north, up. Not finite where a place in degrees lies beyond the map.
  glm::dvec3 operator()(const glm::dvec3& in_file) const;
  /// True if the first two coordinates of the file are its plan, in metres or feet, east first.
  bool are_plane() const { return !is_north_first_ && !target_; }
  /// The middle of the place on the earth (degrees: east, north), where the file's system is known.
  const std::optional<glm::dvec2>& place_deg() const { return place_deg_; }
  /// The system of the metres, as Model::map.
  const std::string& map() const { return map_; }
  /// Where true north lies there, as Model::true_north_deg.
  double true_north_deg() const { return true_north_deg_; }

 private:
  void lay_on(const MapProjection& target);

  bool is_north_first_ = false;
  double plan_unit_m_ = 1.0, height_unit_m_ = 1.0;
  std::optional<MapProjection> own_;     ///< of metres that are laid on another map
  std::optional<MapProjection> target_;  ///< of these, and of degrees
  std::optional<glm::dvec2> place_deg_;
  std::string map_;
  double true_north_deg_ = 0.0;
};

}  // namespace parvis::scene
