// The kind of a building from the attributes and tags that towns give away.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>

#include "formats/city_models/osm_file.h"
#include "scene/data/building_kind.h"

namespace parvis::scene {

/// Attributes of a building of CityGML or CityJSON, as text.
using BuildingAttributes = std::map<std::string, std::string>;

/// Reads the year of construction, the use (code lists of CityGML, ALKIS, PLATEAU and the Swiss register;
/// words of several languages) and the storeys, by the names that attributes have in several countries. What
/// it does not recognise is unknown; no value is an error.
BuildingKind kind_of_building(const BuildingAttributes& attributes);

/// The same from building=, shop=, amenity=, office=, start_date=, building:levels=, building:material= (else
/// of the facade or cladding) and building:colour= of OpenStreetMap.
BuildingKind kind_of_osm_building(const OsmTags& tags);

/// The colour of a value of building:colour= or roof:colour=, sRGB 0..1: "#b04030", "#fff", names of CSS and
/// of mappers ("light_green"). Names that paint alone has in full (red, green) are those of roofs and walls.
std::optional<glm::vec3> colour_in(const std::string& text);

}  // namespace parvis::scene
