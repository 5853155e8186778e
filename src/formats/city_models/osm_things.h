// What stands on the ground of OpenStreetMap: trees, hedges, fences, walls, rails, bridges.
#pragma once

#include "formats/city_models/osm_trenches.h"
#include "formats/readers/ground_on_map.h"

namespace parvis::scene {

/// Adds a tree as a spindle of 12 triangles; those with needles are slimmer, and widest lower. `kind`
/// follows the name SolitaryVegetationObject.
void add_osm_tree(glm::dvec3 foot, double height_m, const std::string& kind, bool has_needles,
                  CityAssembly& city);

/// Limit of the trees along rows. Where there would be more they stand farther apart, with a warning.
inline constexpr std::size_t max_row_trees = 20'000;
/// Radius of a crown, of the tree's height, which bridges keep off.
inline constexpr double crown_share = 0.35;

/// Adds trees (nodes, and every 8 m along rows) as spindles of a few triangles called
/// SolitaryVegetationObject, which the node `greenery` replaces by trees; hedges, fences and walls.
/// No tree stands in a trench, nor so that its crown reaches through a bridge: these are counted in a
/// warning.
void add_osm_plants_and_barriers(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                                 const OsmTrenches& trenches, const RaisedWays& raised, CityAssembly& city);

/// Adds railways on ballast and tram tracks in the street: on the ground as it is `shaped` for streets, or on
/// bridges and ramps, which stand over the bare `ground`. Of those below ground tunnels in level ground are
/// shown.
void add_osm_rails(const OsmFile& osm, const OsmRelief& relief, const GroundOnMap& ground,
                   const GroundOnMap& shaped, CityAssembly& city);

/// Adds decks with parapets below bridges of streets, railways and paths, abutments at their ends, and
/// embankments below ramps of railways and paths, on a terrain of streets, too. Trams on a bridge of a street
/// have none of their own, and paths beside one no parapets. `half_width_m` gives half the width of a way's
/// carriageway, 0 where it has none.
void add_osm_bridges(const OsmFile& osm, const OsmRelief& relief, const GroundOnMap& ground,
                     const std::function<double(const OsmWay&)>& half_width_m, CityAssembly& city);

/// Adds what is painted on crossings (nodes highway=crossing) where a road of `roads` leads over them:
/// stripes, or the lines, dashes or dots that crossing:markings names.
void add_osm_crossings(const OsmFile& osm, const OsmPlaces& place, const std::vector<Road>& roads,
                       const glm::dvec3& origin, CityAssembly& city);

/// Adds a node (land/roads/places_on_map.h) for each traffic light on a road of `roads` (nodes
/// highway=traffic_signals, and crossings whose `crossing` or `crossing:signals` says that they have some),
/// and for each bus stop: nodes highway=bus_stop, and platforms of buses.
void add_osm_signals_and_stops(const OsmFile& osm, const OsmPlaces& place, const std::vector<Road>& roads,
                               const glm::dvec3& origin, const GroundOnMap& ground, Model& model);

}  // namespace parvis::scene
