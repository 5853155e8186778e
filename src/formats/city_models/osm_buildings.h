// Buildings of OpenStreetMap as solids: footprint, height and roof, after the wiki's "Simple 3D Buildings".
#pragma once

#include "formats/city_models/osm_areas.h"
#include "formats/readers/ground_on_map.h"

namespace parvis::scene {

/// Adds every building of ways and multipolygon relations to `city`, each standing on the lowest ground below
/// its outline. Outlines that hold building:part areas give way to these; what is underground is left out.
/// Heights come from height, else building:levels, else what is usual for the kind of building. Roofs get
/// their shape where `find_osm_roof` finds one (points along a side do not count), others are flat. Canopies
/// are slabs on posts, and passages lead through what stands on the ground; undersides are called
/// OuterCeilingSurface. Missing members and nodes are reported by their ids, and the rest is drawn. Returns
/// how many buildings there are.
std::size_t add_osm_buildings(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                              CityAssembly& city);

}  // namespace parvis::scene
