#include "formats/city_models/osm_areas.h"

#include <algorithm>
#include <unordered_map>

namespace parvis::scene {
namespace {

using glm::dvec2;

/// Ways of a relation by their ends.
class OpenWays {
 public:
  explicit OpenWays(std::vector<std::vector<OsmId>> ways)
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

}  // namespace

double area_m2(const OsmRing& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2.0;
}

bool holds(const OsmRing& ring, dvec2 point) {
  bool is_inside = false;
  for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++)
    if ((ring[i].y > point.y) != (ring[k].y > point.y) &&
        point.x < ring[i].x + (ring[k].x - ring[i].x) * (point.y - ring[i].y) / (ring[k].y - ring[i].y))
      is_inside = !is_inside;
  return is_inside;
}

dvec2 middle(const OsmRing& ring) {
  dvec2 sum(0.0);
  for (const dvec2& point : ring) sum += point - ring[0];
  return ring[0] + sum / double(ring.size());
}

std::pair<dvec2, dvec2> box_of(const OsmRing& ring) {
  dvec2 low(ring[0]), high(ring[0]);
  for (const dvec2& point : ring) low = glm::min(low, point), high = glm::max(high, point);
  return {low, high};
}

std::vector<OsmArea> OsmAreas::find(const std::function<bool(const OsmTags&)>& is_wanted,
                                    const std::string& what) const {
  std::vector<OsmArea> found;
  for (const OsmWay& way : osm_.ways)
    if (is_wanted(way.tags)) {
      if (way.is_closed())
        add({{way.nodes}}, {}, way.tags, fmt::format("way {}", way.id), found);
      else if (!what.empty())
        city_.warn(fmt::format("way {}: {} whose outline is not closed is left out", way.id, what));
    }
  for (const OsmRelation& relation : osm_.relations) {
    if (!is_wanted(relation.tags)) continue;
    const std::string& type = tag(relation.tags, "type");
    if (type == "multipolygon") add(relation, "outer", found);
    if (type == "building" && !has_wanted_outline(relation, is_wanted)) add(relation, "outline", found);
  }
  return found;
}

/// Whether an outline of a building says by itself what it is, and is found by that.
bool OsmAreas::has_wanted_outline(const OsmRelation& relation,
                                  const std::function<bool(const OsmTags&)>& is_wanted) const {
  return std::ranges::any_of(relation.members, [&](const OsmRelation::Member& member) {
    if (member.role != "outline") return false;
    const auto way = osm_.way_of.find(member.id);
    return member.type != "way" || (way != osm_.way_of.end() && is_wanted(osm_.ways[way->second].tags));
  });
}

void OsmAreas::add(const OsmRelation& relation, const std::string& outline,
                   std::vector<OsmArea>& found) const {
  const std::string name = fmt::format("relation {}", relation.id);
  add(rings_of(relation, outline, name), rings_of(relation, "inner", name), relation.tags, name, found);
}

/// Ways that follow each other, joined to rings.
std::vector<OsmAreas::NodeRing> OsmAreas::rings_of(const OsmRelation& relation, const std::string& role,
                                                   const std::string& name) const {
  std::vector<NodeRing> open, closed;
  for (const OsmRelation::Member& member : relation.members) {
    if (member.type != "way" || (member.role.empty() ? "outer" : member.role) != role) continue;
    const auto way = osm_.way_of.find(member.id);
    if (way == osm_.way_of.end())
      city_.warn(fmt::format("{}: its way {} is not in the file", name, member.id));
    else if (!osm_.ways[way->second].nodes.empty())
      open.push_back(osm_.ways[way->second].nodes);
  }
  OpenWays ways(std::move(open));
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

/// One footprint for each outer ring, with the holes that lie in it.
void OsmAreas::add(const std::vector<NodeRing>& outer, const std::vector<NodeRing>& inner,
                   const OsmTags& tags, const std::string& name, std::vector<OsmArea>& found) const {
  std::vector<OsmRing> holes;
  for (const NodeRing& nodes : inner)
    if (OsmRing ring = placed(nodes, name); ring.size() >= 3) holes.push_back(std::move(ring));
  for (const NodeRing& nodes : outer) {
    OsmRing ring = placed(nodes, name);
    if (ring.size() < 3) continue;
    if (area_m2(ring) < 0.0) std::reverse(ring.begin(), ring.end());
    OsmArea footprint{{std::move(ring)}, &tags, name};
    for (OsmRing& hole : holes) {
      if (!holds(footprint.rings[0], hole[0])) continue;
      if (area_m2(hole) > 0.0) std::reverse(hole.begin(), hole.end());
      footprint.rings.push_back(hole);
    }
    found.push_back(std::move(footprint));
  }
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
