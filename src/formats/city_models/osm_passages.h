// Passages through buildings of OpenStreetMap: tunnel=building_passage.
#pragma once

#include <array>
#include <optional>

#include "formats/city_models/osm_areas.h"
#include "formats/city_models/osm_points.h"
#include "formats/readers/ground_on_map.h"

namespace parvis::scene {

/// The parts of a building that passages leave.
struct OsmOpening {
  double top_m;                 ///< height of the ceiling, on the map
  std::vector<OsmRing> ground;  ///< outlines of what stands on the ground beside the passages: outer ones
                                ///< counter-clockwise, holes clockwise
  std::vector<std::array<glm::dvec2, 3>> ceiling;  ///< triangles, counter-clockwise
};

/// The ways of a map that lead through buildings.
class OsmPassages {
 public:
  /// An opening has the width of the carriageway or path, or room for trains; it is 3.5 m high, or as
  /// maxheight says, above the highest ground of its way. `city` takes the warnings and must outlive this.
  OsmPassages(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground, CityAssembly& city);

  /// The opening that passages cut into a building whose rings these are (the outline counter-clockwise, then
  /// courtyards clockwise); nothing where no way runs through it. Passages of one building have the height of
  /// the highest. At most 64 pieces of ways are cut out of a building, with a warning.
  std::optional<OsmOpening> through(const std::vector<OsmRing>& rings, const std::string& building) const;

 private:
  /// A straight piece of a way and the ground that it takes, counter-clockwise.
  struct Piece {
    glm::dvec2 from, to;
    OsmRing ground;
    double top_m;
  };
  void add(const std::vector<glm::dvec3>& line, double half_m, double top_m);
  std::vector<const Piece*> pieces_in(const std::vector<OsmRing>& rings, const std::string& building) const;

  std::vector<Piece> pieces_;
  OsmPoints<std::size_t> middles_;  ///< of stretches of the pieces
  CityAssembly& city_;
};

}  // namespace parvis::scene
