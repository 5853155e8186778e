// Coordinate systems of maps by the numbers that the EPSG Geodetic Parameter Dataset gives them, through
// PROJ.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace parvis::scene {

/// An error where PROJ cannot be loaded: to be asked before anything is laid on a map.
Status projections_known();

/// The meaning of a system's coordinates; its heights, if any, come third.
struct MapSystem {
  std::string name;             ///< "JGD2011 + JGD2011 (vertical) height"
  bool is_geographic = false;   ///< the plan is in degrees of longitude and latitude
  bool is_north_first = false;  ///< the first axis points north
  double plan_unit_m = 1.0;     ///< metres per unit of a plan that is not in degrees
  /// Metres per unit of height; nothing: the system has no heights.
  std::optional<double> height_unit_m;
};

/// EPSG's number in the name of a system, of which there are many ways: "EPSG:4326",
/// "urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::5783" (the first of several, its plan),
/// "http://www.opengis.net/def/crs/EPSG/0/6697". Nothing where the name has none.
std::optional<int> epsg_in(std::string_view name);

/// The system of a number. Nothing where PROJ knows none, or none whose plan is in degrees or in a unit of
/// length.
std::optional<MapSystem> map_system(int epsg);

/// Whether a place on a projected map, east first in its own unit, lies in the area that the map is made for,
/// or within a degree of it.
bool lies_in_area(int epsg, glm::dvec2 on_map);

/// Degrees (east, north) of WGS 84 at a place on a projected map, given east first in the map's own unit.
/// Nothing where PROJ knows no such map, or the place lies beyond it.
std::optional<glm::dvec2> place_on_earth(int epsg, glm::dvec2 on_map);

}  // namespace parvis::scene
