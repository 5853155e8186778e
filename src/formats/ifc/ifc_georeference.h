// Where on the earth and on a map an IFC file says that its building stands. A part of the module
// ifcplusplus.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "scene/data/file_account.h"

class BuildingModel;

namespace parvis::scene {

/// The file's own frame on a map, and its place on the earth.
struct IfcGeoreference {
  glm::dvec2 x_axis{1.0, 0.0};  ///< of the file, on the map: of length 1
  glm::dvec3 origin{0.0};       ///< of the file, on the map: metres east, north, up; zero: none is given
  std::string map;              ///< the map's system, "EPSG:25832"; empty: none is named
  double true_north_deg = 0.0;  ///< on the map, at the origin, clockwise from its y axis
  std::optional<glm::dvec2>
      place_deg;  ///< of the site, else of the origin on the map: degrees, east and north
};

/// The place by IfcMapConversion, or by the property sets that stand for it in IFC 2x3 (their scale is not
/// applied, and named in `account`), else by the TrueNorth of the file's context, and by the latitude and
/// longitude of IfcSite. Numbers that are not finite or on no map count as none.
IfcGeoreference georeference_of(BuildingModel& building, FileAccount& account);

/// The same place on another map (formats/terrain/map_projection.h), turned to its north; as it was where one
/// of the two is not known.
IfcGeoreference on_map(IfcGeoreference place, const std::string& map);

}  // namespace parvis::scene
