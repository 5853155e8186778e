// An OpenStreetMap file (XML, API 0.6) as it is written: nodes, ways and relations with their tags.
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

using OsmId = std::int64_t;
using OsmTags = std::map<std::string, std::string>;

/// The value of a tag; empty where it is absent.
const std::string& tag(const OsmTags& tags, const std::string& key);

struct OsmWay {
  OsmId id = 0;
  int line = 0;  ///< of the file
  std::vector<OsmId> nodes;
  OsmTags tags;

  bool is_closed() const { return nodes.size() > 3 && nodes.front() == nodes.back(); }
};

struct OsmRelation {
  struct Member {
    std::string type, role;
    OsmId id = 0;
  };
  OsmId id = 0;
  std::vector<Member> members;
  OsmTags tags;
};

struct OsmFile {
  std::unordered_map<OsmId, glm::dvec2> nodes;  ///< degrees: east, north
  std::vector<OsmWay> ways;
  std::vector<OsmRelation> relations;
  std::unordered_map<OsmId, std::size_t> way_of;  ///< index of each way
  glm::dvec2 min_deg{0.0}, max_deg{0.0};          ///< its bounds as written, or else of its nodes
};

/// Errors tell the line: no OSM, a DOCTYPE, XML that is not well-formed, a file without nodes. A node without
/// a place on the earth, and an element without an id, are warnings; they are left out.
Result<OsmFile> read_osm_file(const std::filesystem::path& file, Errors& warnings);

}  // namespace parvis::scene
