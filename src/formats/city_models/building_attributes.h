// The kind of a building from the attributes and tags that towns give away.
#pragma once

#include <map>
#include <string>

#include "formats/city_models/osm_file.h"
#include "formats/terrain/building_kind.h"

namespace parvis::scene {

/// Attributes of a building of CityGML or CityJSON, as text.
using BuildingAttributes = std::map<std::string, std::string>;

/// Reads the year of construction, the use (code lists of CityGML, ALKIS, PLATEAU and the Swiss register;
/// words of several languages) and the storeys, by the names that attributes have in several countries. What
/// it does not recognise is unknown; no value is an error.
BuildingKind kind_of_building(const BuildingAttributes& attributes);

/// The same from building=, shop=, amenity=, office=, start_date=, building:levels=, building:material= and
/// building:colour= of OpenStreetMap.
BuildingKind kind_of_osm_building(const OsmTags& tags);

}  // namespace parvis::scene
