// Buildings of OpenStreetMap as solids: footprint, height and roof, after the wiki's "Simple 3D Buildings".
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>

#include "formats/city_models/city_assembly.h"
#include "formats/city_models/osm_file.h"
#include "formats/readers/ground_on_map.h"

namespace parvis::scene {

/// Where a node stands on the map, metres; nothing where it is not in the file.
using OsmPlaces = std::function<std::optional<glm::dvec2>(OsmId)>;

/// Adds every building of ways and multipolygon relations to `city`, each standing on the lowest ground below
/// its outline. Outlines that hold
/// building:part areas give way to these. Heights come from height, else building:levels; roofs that are
/// pyramidal, or gabled or hipped over four corners, get their shape, others are flat. Missing members
/// and nodes are reported by their ids, and the rest is drawn. Returns how many buildings there are.
std::size_t add_osm_buildings(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                              CityAssembly& city);

}  // namespace parvis::scene
