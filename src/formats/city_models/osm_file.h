// The content of an OpenStreetMap file (XML or PBF): nodes, ways and relations with their tags.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/result.h"

namespace parvis::scene {

/// Identifier of a node, way or relation; each of the three has its own numbering.
using OsmId = std::int64_t;
/// Tags of an element: keys and values.
using OsmTags = std::map<std::string, std::string>;

/// The value of a tag; empty where it is absent.
const std::string& tag(const OsmTags& tags, const std::string& key);

/// A polyline of nodes; an area where it is closed.
struct OsmWay {
  OsmId id = 0;
  std::vector<OsmId> nodes;
  OsmTags tags;

  /// True if it ends at its first node and has at least three sides.
  bool is_closed() const { return nodes.size() > 3 && nodes.front() == nodes.back(); }
};

/// A group of elements, for example an area with holes (multipolygon).
struct OsmRelation {
  /// An element of the group and its role ("outer").
  struct Member {
    std::string type, role;
    OsmId id = 0;
  };
  OsmId id = 0;
  std::vector<Member> members;
  OsmTags tags;
};

/// A node that stands for a thing by itself: a tree, a crossing.
struct OsmNode {
  OsmId id = 0;
  OsmTags tags;
};

/// All elements of a file, laid on a map.
struct OsmFile {
  std::unordered_map<OsmId, glm::dvec2> nodes;  ///< metres on the map: east, north
  std::vector<OsmNode> tagged_nodes;            ///< those that have tags
  std::vector<OsmWay> ways;
  std::vector<OsmRelation> relations;
  std::unordered_map<OsmId, std::size_t> way_of;  ///< index into `ways` by identifier
  /// Corners of the bounds that the file gives, else of those of its nodes: south-west, south-east,
  /// north-east, north-west, metres on the map.
  std::array<glm::dvec2, 4> corners{};
  glm::dvec2 middle{0.0}, middle_deg{0.0};  ///< of the bounds: on the map, and degrees east and north
  std::uint64_t deleted = 0;                ///< elements that an editor has deleted, which are not here
  std::string map;                          ///< as Model::map
  double true_north_deg = 0.0;              ///< as Model::true_north_deg, in the middle

  /// The way of an identifier; null where it is not in the file.
  const OsmWay* find_way(OsmId id) const {
    const auto found = way_of.find(id);
    return found == way_of.end() ? nullptr : &ways[found->second];
  }
};

/// Reads a file, .osm as XML and .pbf as Protocolbuffer Binary Format, by libosmium. Errors: what the library
/// cannot read; XML with a DOCTYPE or that is not well-formed, by line; another kind of file; no nodes.
/// Degrees become metres of `map` (map_projection.h); empty, or where it is not known: of the UTM zone of the
/// middle, across its borders and the date line, too.
/// Nodes without a valid position are left out with a warning; deleted elements are left out, those
/// that an editor has marked with action="delete" too.
Result<OsmFile> read_osm_file(const std::filesystem::path& file, Errors& warnings,
                              const std::string& map = {});

}  // namespace parvis::scene
