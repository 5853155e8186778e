#include "formats/city_models/osm_areas.h"

#include <algorithm>
#include <array>
#include <set>
#include <unordered_map>

#include "base/plan_polygon.h"
#include "formats/city_models/osm_rings.h"

namespace parvis::scene {
namespace {

using glm::dvec2;

/// Ways of a relation by their ends.
class UnclosedWays {
 public:
  explicit UnclosedWays(std::vector<std::vector<OsmId>> ways)
      : ways_(std::move(ways)), is_taken_(ways_.size(), false) {
    for (std::size_t i = 0; i < ways_.size(); ++i) {
      at_end_[ways_[i].front()].push_back(i);
      at_end_[ways_[i].back()].push_back(i);
    }
  }

  std::size_t size() const { return ways_.size(); }
  /// The way, which is then taken; empty where it was before.
  std::vector<OsmId> take(std::size_t way) {
    if (is_taken_[way]) return {};
    is_taken_[way] = true;
    return std::move(ways_[way]);
  }
  /// Appends a way that goes on where the ring ends; false where none does.
  bool extend(std::vector<OsmId>& ring) {
    std::vector<std::size_t>& next = at_end_[ring.back()];
    while (!next.empty()) {
      std::vector<OsmId> way = take(next.back());
      next.pop_back();
      if (way.empty()) continue;
      if (way.front() != ring.back()) std::reverse(way.begin(), way.end());
      ring.insert(ring.end(), way.begin() + 1, way.end());
      return true;
    }
    return false;
  }

 private:
  std::vector<std::vector<OsmId>> ways_;
  std::vector<bool> is_taken_;
  std::unordered_map<OsmId, std::vector<std::size_t>> at_end_;
};

/// Keys that say what an element is. A multipolygon without one of them is what its outer ways are.
constexpr std::array<const char*, 23> kind_keys{
    {"building",         "building:part", "landuse",      "landcover", "natural",  "leisure",
     "amenity",          "highway",       "area:highway", "waterway",  "water",    "man_made",
     "railway",          "aeroway",       "place",        "tourism",   "historic", "barrier",
     "public_transport", "shop",          "office",       "boundary",  "power"}};

bool says_kind(const OsmTags& tags) {
  return std::ranges::any_of(kind_keys, [&](const char* key) { return tags.contains(key); });
}

bool shares_kind(const OsmTags& a, const OsmTags& b) {
  return std::ranges::any_of(kind_keys, [&](const char* key) { return a.contains(key) && b.contains(key); });
}

bool is_outer(const OsmRelation::Member& member) {
  return member.type == "way" && (member.role == "outer" || member.role.empty());
}

}  // namespace

double area_m2(const OsmRing& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2.0;
}

bool holds(const OsmRing& ring, dvec2 point) { return is_in_ring(ring, point); }

dvec2 middle(const OsmRing& ring) {
  dvec2 sum(0.0);
  for (const dvec2& point : ring) sum += point - ring[0];
  return ring[0] + sum / double(ring.size());
}

double distance_m(const OsmRing& ring, dvec2 point) {
  double nearest_m = 1e30;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 side = ring[(i + 1) % ring.size()] - ring[i], from = point - ring[i];
    const double length2 = glm::dot(side, side);
    const double along = length2 > 0.0 ? std::clamp(glm::dot(from, side) / length2, 0.0, 1.0) : 0.0;
    nearest_m = std::min(nearest_m, glm::distance(from, along * side));
  }
  return nearest_m;
}

std::pair<dvec2, dvec2> box_of(const OsmRing& ring) {
  dvec2 low(ring[0]), high(ring[0]);
  for (const dvec2& point : ring) low = glm::min(low, point), high = glm::max(high, point);
  return {low, high};
}

std::vector<OsmArea> OsmAreas::find(const IsWanted& is_wanted, const std::string& what) const {
  std::vector<OsmArea> found;
  std::set<const OsmWay*> replaced;
  for (const OsmRelation& relation : osm_.relations)
    if (tag(relation.tags, "type") == "multipolygon")
      for (const OsmWay* way : replaced_ways(relation, is_wanted)) replaced.insert(way);
  for (const OsmWay& way : osm_.ways) {
    if (!is_wanted(way.tags) || replaced.contains(&way)) continue;
    if (!way.is_closed()) {
      if (!what.empty())
        city_.warn(fmt::format("way {}: {} whose outline is not closed is left out", way.id, what));
    } else if (tag(way.tags, "area") == "no") {
      if (!what.empty())
        city_.warn(
            fmt::format("way {}: {} with area=no, which says that it is a line, is left out", way.id, what));
    } else {
      add(way, found);
    }
  }
  for (const OsmRelation& relation : osm_.relations) {
    const std::string& type = tag(relation.tags, "type");
    if (type == "multipolygon" && !is_wanted(relation.tags) && !says_kind(relation.tags))
      add_of_outer_ways(relation, is_wanted, found);
    if (!is_wanted(relation.tags)) continue;
    if (type == "multipolygon") add(relation, "outer", found);
    if (type == "building" && !has_wanted_outline(relation, is_wanted)) add(relation, "outline", found);
  }
  return found;
}

/// Whether an outline of a building says by itself what it is, and is found by that.
bool OsmAreas::has_wanted_outline(const OsmRelation& relation, const IsWanted& is_wanted) const {
  return std::ranges::any_of(relation.members, [&](const OsmRelation::Member& member) {
    if (member.role != "outline") return false;
    const OsmWay* way = member.type == "way" ? osm_.find_way(member.id) : nullptr;
    return member.type != "way" || (way && is_wanted(way->tags));
  });
}

std::vector<const OsmWay*> OsmAreas::replaced_ways(const OsmRelation& relation,
                                                   const IsWanted& is_wanted) const {
  std::vector<const OsmWay*> outer, replaced;
  const bool has_own = is_wanted(relation.tags), is_described = says_kind(relation.tags);
  if (is_described && !has_own) return {};
  for (const OsmRelation::Member& member : relation.members) {
    const OsmWay* way = is_outer(member) ? osm_.find_way(member.id) : nullptr;
    if (!way || !is_wanted(way->tags)) continue;
    outer.push_back(way);
    if (!has_own || shares_kind(way->tags, relation.tags)) replaced.push_back(way);
  }
  if (has_own) return replaced;
  // Holes that repeat what stands on the outer ways are holes: so maps were drawn when tags stood there.
  for (const OsmRelation::Member& member : relation.members) {
    const OsmWay* way = member.type == "way" && !is_outer(member) ? osm_.find_way(member.id) : nullptr;
    const auto is_same = [&](const OsmWay* other) { return other->tags == way->tags; };
    if (way && std::ranges::any_of(outer, is_same)) replaced.push_back(way);
  }
  return replaced;
}

void OsmAreas::add(const OsmWay& way, std::vector<OsmArea>& found) const {
  const std::string name = fmt::format("way {}", way.id);
  std::size_t lost = 0;
  for (std::vector<OsmRing>& rings : nested_rings({{placed(way.nodes, name), false}}, lost))
    found.push_back({std::move(rings), &way.tags, name});
}

void OsmAreas::add(const OsmRelation& relation, const std::string& outline,
                   std::vector<OsmArea>& found) const {
  const std::string name = fmt::format("relation {}", relation.id);
  for (std::vector<OsmRing>& rings : footprints_of(relation, outline, name))
    found.push_back({std::move(rings), &relation.tags, name});
}

void OsmAreas::add_of_outer_ways(const OsmRelation& relation, const IsWanted& is_wanted,
                                 std::vector<OsmArea>& found) const {
  std::vector<std::pair<const OsmWay*, dvec2>> tagged;  // with the places where they begin
  for (const OsmRelation::Member& member : relation.members)
    if (const OsmWay* way = is_outer(member) ? osm_.find_way(member.id) : nullptr;
        way && is_wanted(way->tags) && way->nodes.size() >= 2)
      if (const auto a = place_(way->nodes[0]), b = place_(way->nodes[1]); a && b)
        tagged.emplace_back(way, 0.5 * (*a + *b));
  if (tagged.empty()) return;
  for (std::vector<OsmRing>& rings :
       footprints_of(relation, "outer", fmt::format("relation {}", relation.id))) {
    const auto way = std::ranges::find_if(
        tagged, [&](const auto& each) { return distance_m(rings.front(), each.second) < same_place_m; });
    if (way == tagged.end()) continue;
    found.push_back({std::move(rings), &way->first->tags, fmt::format("way {}", way->first->id)});
  }
}

/// One footprint for each area that the rings of a relation enclose, with its holes.
std::vector<std::vector<OsmRing>> OsmAreas::footprints_of(const OsmRelation& relation,
                                                          const std::string& outline,
                                                          const std::string& name) const {
  std::vector<OsmClosedLine> lines;
  for (const bool is_inner : {false, true})
    for (const NodeRing& nodes : rings_of(relation, is_inner ? "inner" : outline, name))
      lines.push_back({placed(nodes, name), is_inner});
  std::size_t lost = 0;
  std::vector<std::vector<OsmRing>> found = nested_rings(lines, lost);
  if (lost > 0)
    city_.warn(fmt::format("{}: {} of its inner rings lie in no outer ring and are left out", name, lost));
  return found;
}

/// Ways that follow each other, joined to rings.
std::vector<OsmAreas::NodeRing> OsmAreas::rings_of(const OsmRelation& relation, const std::string& role,
                                                   const std::string& name) const {
  std::vector<NodeRing> open, closed;
  std::set<OsmId> taken;
  for (const OsmRelation::Member& member : relation.members) {
    if (member.type != "way" || (member.role.empty() ? "outer" : member.role) != role) continue;
    if (!taken.insert(member.id).second) continue;
    const OsmWay* way = osm_.find_way(member.id);
    if (!way)
      city_.warn(fmt::format("{}: its way {} is not in the file", name, member.id));
    else if (!way->nodes.empty())
      open.push_back(way->nodes);
  }
  UnclosedWays ways(std::move(open));
  for (std::size_t i = ways.size(); i-- > 0;) {
    NodeRing ring = ways.take(i);
    if (ring.empty()) continue;
    while (ring.front() != ring.back() && ways.extend(ring)) {
    }
    if (ring.front() == ring.back() && ring.size() > 3)
      closed.push_back(std::move(ring));
    else
      city_.warn(
          fmt::format("{}: its ways make no closed ring at node {}; they are left out", name, ring.back()));
  }
  return closed;
}

OsmRing OsmAreas::placed(const NodeRing& nodes, const std::string& name) const {
  OsmRing ring;
  for (const OsmId node : nodes) {
    const std::optional<dvec2> point = place_(node);
    if (!point)
      city_.warn(fmt::format("{}: its node {} is not in the file; it is drawn without", name, node));
    else if (ring.empty() || ring.back() != *point)
      ring.push_back(*point);
  }
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

}  // namespace parvis::scene
