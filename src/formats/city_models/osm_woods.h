// Trees of the woods of OpenStreetMap, which the map draws as areas alone.
#pragma once

#include "formats/city_models/osm_trenches.h"
#include "formats/readers/ground_on_map.h"

namespace parvis::scene {

/// So many trees stand in all woods of a map at most; larger woods have wider spaces between them.
inline constexpr std::size_t max_wood_trees = 10'000;

/// Adds a tree about every 7 m in woods and forests (natural=wood, landuse=forest), as spindles called
/// "SolitaryVegetationObject wood" and, where leaf_type says so, "needleleaved"; in mixed ones every other
/// tree has needles. Ways, railways, buildings, waters, pitches, car parks and trenches stay free, and what
/// lies below bridges. Where there would be more than max_wood_trees they stand farther apart, with a
/// warning.
void add_osm_woods(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                   const OsmTrenches& trenches, const RaisedWays& raised, CityAssembly& city);

}  // namespace parvis::scene
