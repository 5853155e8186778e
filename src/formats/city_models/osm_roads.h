// Roads of OpenStreetMap: highway=* for vehicles, as centre lines with lanes, directions and limits.
#pragma once

#include "formats/city_models/osm_relief.h"
#include "formats/readers/ground_on_map.h"

namespace parvis::scene {

/// True for ways that vehicles use: highway=* from motorway to service that is no area.
bool is_street(const OsmTags& tags);
/// Half the width of the carriageway of a way for vehicles, metres; 0 for other ways.
double half_carriageway_m(const OsmWay& way);

/// Roads about `origin`, at heights of `relief` above the ground, which is asked on the map. What is below
/// ground is left out, but for tunnels of streets in level ground, which `relief` has dug. Ways that lead
/// through nodes that are not in the file are reported, and drawn through the others; those of which no lanes
/// can be made (one lies along another) are reported, too, and left out.
std::vector<Road> osm_roads(const OsmFile& osm, const OsmPlaces& place, const OsmRelief& relief,
                            const GroundOnMap& ground, const glm::dvec3& origin,
                            const std::filesystem::path& file, CityAssembly& city);

}  // namespace parvis::scene
