// Roofs of OpenStreetMap that stand on posts, open below: carports, petrol stations, platforms, markets.
#pragma once

#include "formats/city_models/osm_areas.h"
#include "formats/city_models/osm_shapes.h"
#include "formats/readers/ground_on_map.h"

namespace parvis::scene {

/// True for building=roof, carport and canopy, for wall=no, and for building:part=roof that does not begin
/// above heads: those stand on the walls of other parts.
bool is_osm_canopy(const OsmTags& tags);

/// Thickness of a canopy's slab, metres, where no min_height says where it begins.
inline constexpr double canopy_slab_m = 0.3;
/// A min_height below this is no underside: people walk below canopies.
inline constexpr double headroom_m = 2.0;

/// Posts of a map's canopies.
class OsmPosts {
 public:
  /// Both must outlive this.
  OsmPosts(const GroundOnMap& ground, CityAssembly& city) : ground_(ground), city_(city) {}

  /// Adds posts inside the corners of the rings and along their edges, from the ground up to `top_m`, a
  /// height on the map. Corners near to a post have none, so that round roofs do not get a fence. Where a map
  /// has more than 20,000 posts, the canopies that follow have none along their edges, with a warning.
  void add(const std::vector<OsmRing>& rings, double top_m);

 private:
  void add(glm::dvec2 foot, glm::dvec2 along, double half_m, double top_m);

  const GroundOnMap& ground_;
  CityAssembly& city_;
  LineLook steel_{{"post", "CityFurniture", ""}};
  std::size_t count_ = 0;
};

}  // namespace parvis::scene
