// Tunnels of OpenStreetMap, and the trenches in which ways lead down to them: holes in what lies level.
#pragma once

#include "formats/city_models/osm_relief.h"
#include "formats/city_models/osm_shapes.h"

namespace parvis::scene {

/// Where the ground is open for ramps that lead down to portals. A trench has room for a carriageway with its
/// pavements.
class OsmTrenches {
 public:
  /// The trenches of all ways that `relief` leads below the ground; none where it digs no tunnels.
  OsmTrenches(const OsmFile& osm, const OsmRelief& relief);

  /// True if there are none.
  bool empty() const { return pieces_.empty(); }
  /// True if the point, on the map, lies in a trench.
  bool holds(glm::dvec2 point) const;
  /// Adds a level surface: its outer ring counter-clockwise, then its holes clockwise. What lies over a
  /// trench is cut away. A surface over more trenches than can be cut out is added whole, with a warning.
  void add_level(const std::vector<std::vector<glm::dvec3>>& rings, const LineLook& look,
                 CityAssembly& city) const;

 private:
  /// A convex part of a trench, counter-clockwise, and the box around it.
  struct Piece {
    OsmRing ring;
    glm::dvec2 low, high;
  };
  std::vector<Piece> pieces_;
};

/// Adds what is built below the ground: floors, walls and ceilings of tunnels, walls across their portals,
/// and floors and walls of trenches, with parapets. Tunnels end at a wall where nothing leads out of them.
void add_osm_tunnels(const OsmFile& osm, const OsmRelief& relief, CityAssembly& city);

}  // namespace parvis::scene
