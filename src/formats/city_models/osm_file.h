// The content of an OpenStreetMap file (XML, API 0.6): nodes, ways and relations with their tags.
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
  int line = 0;  ///< of the file
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

/// All elements of a file.
struct OsmFile {
  std::unordered_map<OsmId, glm::dvec2> nodes;  ///< degrees: east, north
  std::vector<OsmWay> ways;
  std::vector<OsmRelation> relations;
  std::unordered_map<OsmId, std::size_t> way_of;  ///< index into `ways` by identifier
  glm::dvec2 min_deg{0.0}, max_deg{0.0};          ///< bounds given by the file, else those of its nodes
};

/// Reads a file. Errors name the line: not OSM, a DOCTYPE, XML that is not well-formed, no nodes. Nodes
/// without a valid position and elements without an identifier are left out with a warning.
Result<OsmFile> read_osm_file(const std::filesystem::path& file, Errors& warnings);

}  // namespace parvis::scene
