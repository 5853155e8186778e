// What roofs of OpenStreetMap are made of that have neither tiles nor gravel.
#pragma once

#include <string>

#include "formats/city_models/city_assembly.h"
#include "formats/city_models/osm_file.h"

namespace parvis::scene {

/// The look of all faces of one roof.
struct OsmRoofFinish {
  std::string name;         ///< "metal", "copper", "glass", "thatch" or "green"; empty: tiles or gravel
  int material = no_index;  ///< from CityAssembly::add_material
};

/// The finish by roof:material=, in the colour of roof:colour=. Domes, onions and round roofs without a
/// material are of sheet metal, for neither tiles nor gravel stay on them; so are canopies. Nothing for
/// others: what chooses tiles and gravel by slope would lay gravel on the top of a dome.
OsmRoofFinish finish_of_osm_roof(const OsmTags& tags, const std::string& shape, bool is_canopy,
                                 CityAssembly& city);

}  // namespace parvis::scene
