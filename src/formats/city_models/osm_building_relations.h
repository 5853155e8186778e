// Which parts and which outline are one building: by relations of the type "building", whose members say so
// by their roles, and by how much of the outline its parts cover.
#pragma once

#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "formats/city_models/osm_areas.h"
#include "formats/city_models/osm_file.h"

namespace parvis::scene {

/// The relations of a map that name the parts of buildings.
class OsmBuildingRelations {
 public:
  explicit OsmBuildingRelations(const OsmFile& osm);

  /// Whether an area ("way 12") is named as the part of a building, and not as an outline.
  bool is_part(const std::string& name) const;
  /// The areas that are named as parts of the building with this outline.
  std::span<const std::string> parts_of(const std::string& outline) const;

 private:
  std::unordered_map<std::string, std::size_t> relation_of_outline_;
  std::unordered_set<std::string> named_parts_;
  std::vector<std::vector<std::string>> parts_;  ///< by relation
};

/// Whether the parts stand in place of their outline. Parts that cover little of it (the tower of a church, a
/// chimney) are all that somebody has mapped so far: the outline is drawn, too.
bool parts_cover(const OsmArea& outline, std::span<const OsmArea* const> parts);

}  // namespace parvis::scene
