#include "formats/city_models/osm_buildings.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "formats/city_models/polygon_triangles.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;
using Ring = std::vector<dvec2>;

constexpr double level_m = 3.0, usual_levels = 2.0;
constexpr double roof_slope = 0.6;  // of gables and hips without a height: 31 degrees

/// A footprint: the outer ring counter-clockwise, holes clockwise, without repeated points.
struct Footprint {
  std::vector<Ring> rings;
  const OsmTags* tags;
  double ground_m = 0.0;  ///< on which it stands
};

double area_m2(const Ring& ring) {
  double twice = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const dvec2 a = ring[i] - ring[0], b = ring[(i + 1) % ring.size()] - ring[0];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2.0;
}

bool holds(const Ring& ring, dvec2 point) {
  bool is_inside = false;
  for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++)
    if ((ring[i].y > point.y) != (ring[k].y > point.y) &&
        point.x < ring[i].x + (ring[k].x - ring[i].x) * (point.y - ring[i].y) / (ring[k].y - ring[i].y))
      is_inside = !is_inside;
  return is_inside;
}

dvec2 middle(const Ring& ring) {
  dvec2 sum(0.0);
  for (const dvec2& point : ring) sum += point - ring[0];
  return ring[0] + sum / double(ring.size());
}

/// "12", "12.5 m", "40'" (feet), "12;15" (the first).
std::optional<double> metres(const std::string& text) {
  double value = 0.0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || !(std::abs(value) < 2000.0)) return std::nullopt;  // no building is as high
  constexpr double foot_m = 0.3048;
  return *end == '\'' ? value * foot_m : value;
}

double metres_or(const OsmTags& tags, const char* height, const char* levels, double otherwise) {
  if (const auto given = metres(tag(tags, height))) return *given;
  if (const auto given = metres(tag(tags, levels))) return *given * level_m;
  return otherwise;
}

/// Draws one building.
class Building {
 public:
  Building(const Footprint& footprint, const CityObject& object, CityAssembly& city)
      : rings_(footprint.rings), ground_m_(footprint.ground_m), object_(object), city_(city) {
    const OsmTags& tags = *footprint.tags;
    shape_ = tag(tags, "roof:shape");
    base_m_ = std::max(metres_or(tags, "min_height", "building:min_level", 0.0), 0.0);
    top_m_ = metres_or(tags, "height", "building:levels", base_m_ + usual_levels * level_m);
    if (top_m_ <= base_m_) top_m_ = base_m_ + level_m;
    const bool gives_top = !tag(tags, "height").empty();
    const double roof_m = std::max(metres_or(tags, "roof:height", "roof:levels", usual_roof_m()), 0.0);
    if (!gives_top) top_m_ += has_slopes() ? roof_m : 0.0;  // levels do not count those in the roof
    eaves_m_ = has_slopes() ? std::max(top_m_ - roof_m, base_m_) : top_m_;
  }

  void draw() {
    for (const Ring& ring : rings_)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        if (eaves_m_ > base_m_)
          add("WallSurface", {{{a, base_m_}, {b, base_m_}, {b, eaves_m_}, {a, eaves_m_}}});
      }
    if (base_m_ > 0.0) add("OuterCeilingSurface", level_surface(base_m_, true));
    draw_roof();
  }

 private:
  bool is_pyramid() const { return shape_ == "pyramidal" && rings_.size() == 1; }
  bool has_ridge() const {
    return (shape_ == "gabled" || shape_ == "hipped") && rings_.size() == 1 && rings_[0].size() == 4;
  }
  bool has_slopes() const { return is_pyramid() || has_ridge(); }

  double usual_roof_m() const {
    const Ring& ring = rings_[0];
    if (has_ridge())
      return roof_slope / 2.0 * std::min(glm::distance(ring[0], ring[1]), glm::distance(ring[1], ring[2]));
    return roof_slope * std::sqrt(std::abs(area_m2(ring))) / 2.0;
  }

  void draw_roof() {
    if (!has_slopes()) return add("RoofSurface", level_surface(top_m_, false));
    const Ring& ring = rings_[0];
    const auto eave = [&](std::size_t i) { return dvec3(ring[i % ring.size()], eaves_m_); };
    if (is_pyramid()) {
      const dvec3 apex(middle(ring), top_m_);
      for (std::size_t i = 0; i < ring.size(); ++i) add("RoofSurface", {{eave(i), eave(i + 1), apex}});
      return;
    }
    // the ridge runs along the longer sides, which begin at the corners `first` and `first` + 2
    const std::size_t first = glm::distance(ring[0], ring[1]) >= glm::distance(ring[1], ring[2]) ? 0 : 1;
    const dvec2 back = (ring[(first + 3) % 4] + ring[first]) / 2.0,
                front = (ring[first + 1] + ring[(first + 2) % 4]) / 2.0;
    const bool is_hipped = shape_ == "hipped";
    const double inset = is_hipped ? std::min(0.45, glm::distance(ring[first + 1], ring[(first + 2) % 4]) /
                                                        (2.0 * glm::distance(back, front)))
                                   : 0.0;
    const dvec3 ridge_back(glm::mix(back, front, inset), top_m_),
        ridge_front(glm::mix(front, back, inset), top_m_);
    const char* end_surface = is_hipped ? "RoofSurface" : "WallSurface";
    add("RoofSurface", {{eave(first), eave(first + 1), ridge_front, ridge_back}});
    add(end_surface, {{eave(first + 1), eave(first + 2), ridge_front}});
    add("RoofSurface", {{eave(first + 2), eave(first + 3), ridge_back, ridge_front}});
    add(end_surface, {{eave(first + 3), eave(first), ridge_back}});
  }

  std::vector<std::vector<dvec3>> level_surface(double height_m, bool faces_down) const {
    std::vector<std::vector<dvec3>> surface;
    for (const Ring& ring : rings_) {
      std::vector<dvec3>& points = surface.emplace_back();
      for (const dvec2& point : ring) points.emplace_back(point, height_m);
      if (faces_down) std::reverse(points.begin(), points.end());
    }
    return surface;
  }

  void add(const char* semantics, std::vector<std::vector<dvec3>> rings) {
    for (std::vector<dvec3>& ring : rings)
      for (dvec3& point : ring) point.z += ground_m_;
    CitySurface surface;
    surface.rings = std::move(rings);
    surface.semantics = semantics;
    surface.is_of_solid = true;
    city_.add(object_, surface);
  }

  const std::vector<Ring>& rings_;
  double ground_m_;
  const CityObject& object_;
  CityAssembly& city_;
  std::string shape_;
  double base_m_, eaves_m_, top_m_;  ///< above the ground
};

/// Finds the footprints of a file.
class Footprints {
 public:
  Footprints(const OsmFile& osm, const OsmPlaces& place, CityAssembly& city)
      : osm_(osm), place_(place), city_(city) {}

  /// Of everything that has a tag of this key ("building") with another value than "no".
  std::vector<Footprint> with(const std::string& key) {
    const auto has_key = [&](const OsmTags& tags) {
      return !tag(tags, key).empty() && tag(tags, key) != "no";
    };
    std::vector<Footprint> found;
    for (const OsmWay& way : osm_.ways)
      if (has_key(way.tags)) {
        if (way.is_closed())
          add({{way.nodes}}, {}, way.tags, fmt::format("way {}", way.id), found);
        else
          city_.warn(fmt::format("way {}: a building whose outline is not closed is left out", way.id));
      }
    for (const OsmRelation& relation : osm_.relations)
      if (has_key(relation.tags) && tag(relation.tags, "type") == "multipolygon") add(relation, found);
    return found;
  }

 private:
  using NodeRing = std::vector<OsmId>;

  void add(const OsmRelation& relation, std::vector<Footprint>& found) {
    const std::string name = fmt::format("relation {}", relation.id);
    add(rings_of(relation, "outer", name), rings_of(relation, "inner", name), relation.tags, name, found);
  }

  /// Ways that follow each other, joined to rings.
  std::vector<NodeRing> rings_of(const OsmRelation& relation, const std::string& role,
                                 const std::string& name) {
    std::vector<NodeRing> open, closed;
    for (const OsmRelation::Member& member : relation.members) {
      if (member.type != "way" || (member.role.empty() ? "outer" : member.role) != role) continue;
      const auto way = osm_.way_of.find(member.id);
      if (way == osm_.way_of.end())
        city_.warn(fmt::format("{}: its way {} is not in the file", name, member.id));
      else if (!osm_.ways[way->second].nodes.empty())
        open.push_back(osm_.ways[way->second].nodes);
    }
    while (!open.empty()) {
      NodeRing ring = std::move(open.back());
      open.pop_back();
      while (ring.front() != ring.back() && extend(ring, open)) {
      }
      if (ring.front() == ring.back() && ring.size() > 3)
        closed.push_back(std::move(ring));
      else
        city_.warn(
            fmt::format("{}: its ways make no closed ring at node {}; they are left out", name, ring.back()));
    }
    return closed;
  }

  static bool extend(NodeRing& ring, std::vector<NodeRing>& open) {
    for (auto next = open.begin(); next != open.end(); ++next) {
      if (next->back() == ring.back()) std::reverse(next->begin(), next->end());
      if (next->front() != ring.back()) continue;
      ring.insert(ring.end(), next->begin() + 1, next->end());
      open.erase(next);
      return true;
    }
    return false;
  }

  /// One footprint for each outer ring, with the holes that lie in it.
  void add(const std::vector<NodeRing>& outer, const std::vector<NodeRing>& inner, const OsmTags& tags,
           const std::string& name, std::vector<Footprint>& found) {
    std::vector<Ring> holes;
    for (const NodeRing& nodes : inner)
      if (Ring ring = placed(nodes, name); ring.size() >= 3) holes.push_back(std::move(ring));
    for (const NodeRing& nodes : outer) {
      Ring ring = placed(nodes, name);
      if (ring.size() < 3) continue;
      if (area_m2(ring) < 0.0) std::reverse(ring.begin(), ring.end());
      Footprint footprint{{std::move(ring)}, &tags};
      for (Ring& hole : holes) {
        if (!holds(footprint.rings[0], hole[0])) continue;
        if (area_m2(hole) > 0.0) std::reverse(hole.begin(), hole.end());
        footprint.rings.push_back(hole);
      }
      found.push_back(std::move(footprint));
    }
  }

  Ring placed(const NodeRing& nodes, const std::string& name) {
    Ring ring;
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

  const OsmFile& osm_;
  const OsmPlaces& place_;
  CityAssembly& city_;
};

double lowest_m(const Ring& ring, const GroundOnMap& ground) {
  if (!ground) return 0.0;
  double min_m = ground(ring.front());
  for (const dvec2& point : ring) min_m = std::min(min_m, ground(point));
  return min_m;
}

}  // namespace

std::size_t add_osm_buildings(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                              CityAssembly& city) {
  Footprints footprints(osm, place, city);
  std::vector<Footprint> drawn = footprints.with("building:part");
  const std::size_t parts = drawn.size();
  for (Footprint& part : drawn) part.ground_m = lowest_m(part.rings[0], ground);
  for (Footprint& outline : footprints.with("building")) {
    outline.ground_m = lowest_m(outline.rings[0], ground);
    bool has_parts = false;
    for (std::size_t i = 0; i < parts; ++i) {
      if (drawn[i].tags == outline.tags || !holds(outline.rings[0], middle(drawn[i].rings[0]))) continue;
      has_parts = true;
      drawn[i].ground_m = outline.ground_m;  // the parts of a building stand level with each other
    }
    if (!has_parts) drawn.push_back(std::move(outline));
  }
  for (const Footprint& footprint : drawn) Building(footprint, {"building", "Building", ""}, city).draw();
  return drawn.size();
}

}  // namespace parvis::scene
