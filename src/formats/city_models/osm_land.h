// What lies on the ground of OpenStreetMap: parks, grass, woods, water, squares, car parks, footpaths.
#pragma once

#include "formats/city_models/osm_trenches.h"

namespace parvis::scene {

/// Adds areas and paths as surfaces on a level ground at `ground_m`, each a few millimetres above those that
/// it lies in, without what `trenches` open. They are called PlantCover, WaterBody, TransportSquare and
/// "Road" with a use ("Road footway").
void add_osm_land(const OsmFile& osm, const OsmPlaces& place, double ground_m, const OsmTrenches& trenches,
                  CityAssembly& city);

/// Whether tags are those of an area or a path that is drawn on level ground.
bool is_on_ground(const OsmTags& tags);

/// Half the width of a footpath, cycleway, flight of steps or track; 0 for all else.
double half_path_m(const OsmTags& tags);

}  // namespace parvis::scene
