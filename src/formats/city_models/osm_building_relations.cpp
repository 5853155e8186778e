#include "formats/city_models/osm_building_relations.h"

#include <algorithm>
#include <utility>

namespace parvis::scene {
namespace {

using glm::dvec2;

constexpr double min_covered = 0.15;  // of an outline, that parts cover
constexpr int samples_per_side = 24;  // of the outline's box

bool is_in(const OsmArea& area, dvec2 point) {
  return holds(area.rings.front(), point) &&
         std::none_of(area.rings.begin() + 1, area.rings.end(),
                      [&](const OsmRing& hole) { return holds(hole, point); });
}

}  // namespace

OsmBuildingRelations::OsmBuildingRelations(const OsmFile& osm) {
  for (const OsmRelation& relation : osm.relations) {
    if (tag(relation.tags, "type") != "building") continue;
    std::vector<std::string>& parts = parts_.emplace_back();
    relation_of_outline_.emplace(fmt::format("relation {}", relation.id), parts_.size() - 1);
    for (const OsmRelation::Member& member : relation.members) {
      std::string name = fmt::format("{} {}", member.type, member.id);
      if (member.role == "outline") relation_of_outline_.emplace(std::move(name), parts_.size() - 1);
      if (member.role != "part") continue;
      named_parts_.insert(name);
      parts.push_back(std::move(name));
    }
  }
}

bool OsmBuildingRelations::is_part(const std::string& name) const {
  return named_parts_.contains(name) && !relation_of_outline_.contains(name);
}

std::span<const std::string> OsmBuildingRelations::parts_of(const std::string& outline) const {
  const auto relation = relation_of_outline_.find(outline);
  if (relation == relation_of_outline_.end()) return {};
  return parts_[relation->second];
}

bool parts_cover(const OsmArea& outline, std::span<const OsmArea* const> parts) {
  const auto [low, high] = box_of(outline.rings.front());
  std::vector<std::pair<dvec2, dvec2>> boxes;
  boxes.reserve(parts.size());
  for (const OsmArea* part : parts) boxes.push_back(box_of(part->rings.front()));
  int inside = 0, covered = 0;
  for (int i = 0; i < samples_per_side * samples_per_side; ++i) {
    const dvec2 share((i % samples_per_side + 0.5) / samples_per_side,
                      (i / samples_per_side + 0.5) / samples_per_side);
    const dvec2 point = glm::mix(low, high, share);
    if (!is_in(outline, point)) continue;
    ++inside;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const bool is_near = glm::all(glm::greaterThanEqual(point, boxes[k].first)) &&
                           glm::all(glm::lessThanEqual(point, boxes[k].second));
      if (!is_near || !is_in(*parts[k], point)) continue;
      ++covered;
      break;
    }
  }
  // An outline so thin that no sample lies in it is no house beside its parts.
  return inside == 0 || covered >= min_covered * inside;
}

}  // namespace parvis::scene
