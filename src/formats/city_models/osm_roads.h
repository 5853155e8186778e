// Roads of OpenStreetMap: highway=* for vehicles, as centre lines with lanes, directions and limits.
#pragma once

#include "formats/city_models/osm_buildings.h"

namespace parvis::scene {

/// Each at its way's line of `file`, on the ground, which is asked in the frame of `place`. Bridges pass
/// above what they cross, tunnels are left out. Ways that lead through nodes that are not in the file are
/// reported, and drawn through the others; those of which no lanes can be made (one lies along another) are
/// reported, too, and left out.
std::vector<Road> osm_roads(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                            const std::filesystem::path& file, CityAssembly& city);

}  // namespace parvis::scene
