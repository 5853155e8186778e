// The content of an OpenStreetMap file (XML or PBF): nodes, ways and relations with their tags.
#pragma once

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

/// All elements of a file.
struct OsmFile {
  std::unordered_map<OsmId, glm::dvec2> nodes;  ///< degrees: east, north
  std::vector<OsmNode> tagged_nodes;            ///< those that have tags
  std::vector<OsmWay> ways;
  std::vector<OsmRelation> relations;
  std::unordered_map<OsmId, std::size_t> way_of;  ///< index into `ways` by identifier
  glm::dvec2 min_deg{0.0}, max_deg{0.0};          ///< bounds given by the file, else those of its nodes
};

/// Reads a file, .osm as XML and .pbf as Protocolbuffer Binary Format, by libosmium. Errors: what the library
/// cannot read; XML with a DOCTYPE or that is not well-formed, by line; another kind of file; no nodes.
/// Nodes without a valid position are left out with a warning; deleted elements are left out.
Result<OsmFile> read_osm_file(const std::filesystem::path& file, Errors& warnings);

}  // namespace parvis::scene
