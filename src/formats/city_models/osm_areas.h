// Areas of OpenStreetMap: closed ways and multipolygon relations as rings on the map.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/city_models/city_assembly.h"
#include "formats/city_models/osm_file.h"

namespace parvis::scene {

/// Where a node stands on the map, metres; nothing where it is not in the file.
using OsmPlaces = std::function<std::optional<glm::dvec2>(OsmId)>;

/// Corners of a ring on the map, metres, without a repeated last one.
using OsmRing = std::vector<glm::dvec2>;

/// An area: the outer ring counter-clockwise, then its holes clockwise.
struct OsmArea {
  std::vector<OsmRing> rings;
  const OsmTags* tags;
  std::string name;       ///< of the way or relation, for messages: "way 12"
  double ground_m = 0.0;  ///< on which it stands
};

/// Signed area: positive where the ring runs counter-clockwise.
double area_m2(const OsmRing& ring);
/// True if the point lies inside the ring.
bool holds(const OsmRing& ring, glm::dvec2 point);
/// Mean of the corners.
glm::dvec2 middle(const OsmRing& ring);
/// The lowest and the highest coordinates of its corners.
std::pair<glm::dvec2, glm::dvec2> box_of(const OsmRing& ring);

/// Finds the areas of a file.
class OsmAreas {
 public:
  /// All must outlive this; `city` takes the warnings.
  OsmAreas(const OsmFile& osm, const OsmPlaces& place, CityAssembly& city)
      : osm_(osm), place_(place), city_(city) {}

  /// The areas whose tags are wanted. Ways that are not closed are reported as `what` ("a building") and left
  /// out, or left out silently where `what` is empty: they are lines. Missing members and nodes are reported
  /// by their ids, and the rest is kept.
  std::vector<OsmArea> find(const std::function<bool(const OsmTags&)>& is_wanted,
                            const std::string& what) const;

 private:
  using NodeRing = std::vector<OsmId>;

  bool has_wanted_outline(const OsmRelation& relation,
                          const std::function<bool(const OsmTags&)>& is_wanted) const;
  /// `outline`: the role of the ways round it.
  void add(const OsmRelation& relation, const std::string& outline, std::vector<OsmArea>& found) const;
  void add(const std::vector<NodeRing>& outer, const std::vector<NodeRing>& inner, const OsmTags& tags,
           const std::string& name, std::vector<OsmArea>& found) const;
  std::vector<NodeRing> rings_of(const OsmRelation& relation, const std::string& role,
                                 const std::string& name) const;
  OsmRing placed(const NodeRing& nodes, const std::string& name) const;

  const OsmFile& osm_;
  const OsmPlaces& place_;
  CityAssembly& city_;
};

}  // namespace parvis::scene
