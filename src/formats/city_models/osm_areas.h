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
#include "formats/city_models/osm_rings.h"

namespace parvis::scene {

/// Where a node stands on the map, metres; nothing where it is not in the file.
using OsmPlaces = std::function<std::optional<glm::dvec2>(OsmId)>;

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
/// How far a point lies from the nearest side.
double distance_m(const OsmRing& ring, glm::dvec2 point);
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

  /// The areas whose tags are wanted. Ways that are not closed, and those with area=no, are reported as
  /// `what`
  /// ("a building") and left out, or left out silently where `what` is empty: they are lines. Where the tags
  /// of a multipolygon stand on its outer ways alone, or there too, the ways are areas with its holes.
  /// Missing members and nodes are reported by their ids, and the rest is kept.
  std::vector<OsmArea> find(const std::function<bool(const OsmTags&)>& is_wanted,
                            const std::string& what) const;

 private:
  using NodeRing = std::vector<OsmId>;
  using IsWanted = std::function<bool(const OsmTags&)>;

  bool has_wanted_outline(const OsmRelation& relation, const IsWanted& is_wanted) const;
  /// The ways that a multipolygon stands for, so that they are no areas by themselves.
  std::vector<const OsmWay*> replaced_ways(const OsmRelation& relation, const IsWanted& is_wanted) const;
  void add(const OsmWay& way, std::vector<OsmArea>& found) const;
  /// `outline`: the role of the ways round it.
  void add(const OsmRelation& relation, const std::string& outline, std::vector<OsmArea>& found) const;
  /// Adds the areas of a relation with the tags of its outer ways.
  void add_of_outer_ways(const OsmRelation& relation, const IsWanted& is_wanted,
                         std::vector<OsmArea>& found) const;
  std::vector<std::vector<OsmRing>> footprints_of(const OsmRelation& relation, const std::string& outline,
                                                  const std::string& name) const;
  std::vector<NodeRing> rings_of(const OsmRelation& relation, const std::string& role,
                                 const std::string& name) const;
  OsmRing placed(const NodeRing& nodes, const std::string& name) const;

  const OsmFile& osm_;
  const OsmPlaces& place_;
  CityAssembly& city_;
};

}  // namespace parvis::scene
