#include "formats/city_models/osm_passages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "formats/city_models/osm_land.h"
#include "formats/city_models/osm_measures.h"
#include "formats/city_models/osm_relief.h"
#include "formats/city_models/osm_roads.h"
#include "formats/city_models/osm_shapes.h"
#include "formats/city_models/polygon_crossings.h"
#include "formats/city_models/polygon_triangles.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;
using Rings = std::vector<std::vector<dvec3>>;

constexpr double usual_passage_m = 3.5, usual_rail_height_m = 5.0;
constexpr double min_passage_m = 2.0, max_passage_m = 12.0;  // of what maxheight may say
constexpr double passage_beside_road_m = 0.4, passage_rail_half_m = 2.0, passage_path_half_m = 1.2;
constexpr double beyond_end_m = 0.3;       // of half a passage: for walls that it meets at an angle
constexpr double max_straight_m = 500.0;   // of a straight piece: no building is as deep
constexpr double stretch_m = 20.0;         // between the points by which pieces are found
constexpr double shortest_inside_m = 0.5;  // a way that has no more of itself in a building passes by
constexpr std::size_t max_pieces = 64, max_near = 256;  // through one building, and in the box around it
constexpr double smallest_m2 = 0.1;                     // of a ceiling
constexpr dvec3 upward(0.0, 0.0, 1.0);

/// Half the width of an opening for a way; 0: it needs none.
double half_passage_m(const OsmWay& way) {
  if (tag(way.tags, "tunnel") != "building_passage" || tag(way.tags, "area") == "yes") return 0.0;
  if (is_rail(way.tags)) return passage_rail_half_m;
  if (const double half_m = half_carriageway_m(way); half_m > 0.0) return half_m + passage_beside_road_m;
  return says_yes(way.tags, "highway") ? std::max(half_path_m(way.tags), passage_path_half_m) : 0.0;
}

double clearance_m(const OsmTags& tags) {
  for (const char* key : {"maxheight:physical", "maxheight"})
    if (const auto given = metres_in(tag(tags, key));
        given && *given >= min_passage_m && *given <= max_passage_m)
      return *given;
  return is_rail(tags) ? usual_rail_height_m : usual_passage_m;
}

/// How much of a line from a to b lies inside rings, m.
double inside_m(dvec2 a, dvec2 b, const std::vector<OsmRing>& rings) {
  const dvec2 along = b - a;
  const double length_m = glm::length(along);
  const auto side = [&](dvec2 p) { return along.x * (p.y - a.y) - along.y * (p.x - a.x); };
  std::vector<double> crossings;  // of the endless line, as shares of the way from a to b
  for (const OsmRing& ring : rings)
    for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++) {
      const double from = side(ring[k]), to = side(ring[i]);
      if ((from > 0.0) == (to > 0.0)) continue;
      const dvec2 at = glm::mix(ring[k], ring[i], from / (from - to));
      crossings.push_back(glm::dot(at - a, along) / (length_m * length_m));
    }
  std::ranges::sort(crossings);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
    sum += std::max(std::min(crossings[i + 1], 1.0) - std::max(crossings[i], 0.0), 0.0);
  return length_m * sum;
}

/// The ring about `origin`, for far coordinates would cost crossings their digits.
std::vector<dvec3> about(dvec2 origin, const OsmRing& ring) {
  std::vector<dvec3> points;
  points.reserve(ring.size());
  for (const dvec2& point : ring) points.emplace_back(point - origin, 0.0);
  return points;
}

/// The outlines of what rings hold by a rule; nothing where they cross too often.
std::optional<Rings> outlined(const Rings& rings, Inside inside) {
  if (!can_be_triangulated(rings, upward)) return std::nullopt;
  return outlines(rings, upward, inside);
}

Rings joined(Rings first, const Rings& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Turns the other way round.
Rings reversed(Rings rings) {
  for (std::vector<dvec3>& ring : rings) std::ranges::reverse(ring);
  return rings;
}

/// A building without the ground of its passages, and what lies above that; nothing where outlines cross too
/// often.
std::optional<OsmOpening> cut_open(const std::vector<OsmRing>& building, const Rings& passages,
                                   dvec2 origin) {
  Rings rings;
  rings.reserve(building.size());
  for (const OsmRing& ring : building) rings.push_back(about(origin, ring));
  const std::optional<Rings> whole = outlined(rings, Inside::odd),
                             taken = outlined(passages, Inside::positive);
  if (!whole || !taken) return std::nullopt;
  const Rings both = joined(*whole, *taken);
  const std::optional<Rings> left = outlined(joined(*whole, reversed(*taken)), Inside::positive);
  if (!left || !can_be_triangulated(both, upward)) return std::nullopt;
  OsmOpening opening{};
  opening.ground.reserve(left->size());
  for (const std::vector<dvec3>& ring : *left) {
    OsmRing& corners = opening.ground.emplace_back();
    corners.reserve(ring.size());
    for (const dvec3& point : ring) corners.push_back(dvec2(point) + origin);
  }
  std::vector<dvec3> points;
  const std::vector<std::uint32_t> triangles = triangulated(both, upward, points, Inside::twice);
  opening.ceiling.reserve(triangles.size() / 3);
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
    opening.ceiling.push_back({dvec2(points[triangles[i]]) + origin, dvec2(points[triangles[i + 1]]) + origin,
                               dvec2(points[triangles[i + 2]]) + origin});
  return opening;
}

double triangles_area_m2(const std::vector<std::array<dvec2, 3>>& triangles) {
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) sum += scene::area_m2({a, b, c});
  return sum;
}

}  // namespace

OsmPassages::OsmPassages(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                         CityAssembly& city)
    : city_(city) {
  for (const OsmWay& way : osm.ways) {
    const double half_m = half_passage_m(way);
    if (half_m <= 0.0) continue;
    std::vector<dvec3> line;
    double ground_m = ground ? -1e9 : 0.0;
    for (const OsmId node : way.nodes)
      if (const auto point = place(node)) {
        line.emplace_back(*point, 0.0);
        if (ground) ground_m = std::max(ground_m, ground(*point));
      }
    if (line.size() >= 2) add(line, half_m, ground_m + clearance_m(way.tags));
  }
}

void OsmPassages::add(const std::vector<dvec3>& line, double half_m, double top_m) {
  std::vector<dvec3> longer = line;  // ends lie on walls, which may not run across the way
  const auto lengthen = [&](dvec3& end, const dvec3& before) {
    if (const double length_m = glm::distance(end, before); length_m > 0.0)
      end += (end - before) / length_m * (half_m + beyond_end_m);
  };
  lengthen(longer.front(), line[1]), lengthen(longer.back(), line[line.size() - 2]);
  const Sides sides = sides_of(longer, -half_m, half_m, 0.0);
  for (std::size_t i = 0; i + 1 < sides.left.size(); ++i) {
    const auto middle = [&](std::size_t k) { return 0.5 * dvec2(sides.left[k] + sides.right[k]); };
    const Piece piece{i == 0 ? dvec2(line.front()) : middle(i),
                      i + 2 == sides.left.size() ? dvec2(line.back()) : middle(i + 1),
                      {sides.right[i], sides.right[i + 1], sides.left[i + 1], sides.left[i]},
                      top_m};
    const double length_m = glm::distance(piece.from, piece.to);
    if (!(length_m < max_straight_m)) continue;
    const int stretches = int(std::ceil(length_m / stretch_m));
    for (int k = 0; k < stretches; ++k)
      middles_.add(glm::mix(piece.from, piece.to, (double(k) + 0.5) / double(stretches)), pieces_.size());
    pieces_.push_back(piece);
  }
}

std::vector<const OsmPassages::Piece*> OsmPassages::pieces_in(const std::vector<OsmRing>& rings,
                                                              const std::string& building) const {
  const auto [low, high] = box_of(rings[0]);
  std::set<std::size_t> near;
  middles_.each_in(low - 0.5 * stretch_m, high + 0.5 * stretch_m,
                   [&](dvec2, std::size_t piece) { near.insert(piece); });
  std::vector<const Piece*> found;
  std::size_t sought = 0;
  for (const std::size_t index : near) {
    const Piece& piece = pieces_[index];
    if (++sought > max_near || found.size() == max_pieces) {
      city_.warn(fmt::format("{}: more than {} passages lead through it; others are left out", building,
                             max_pieces));
      break;
    }
    if (inside_m(piece.from, piece.to, rings) > shortest_inside_m) found.push_back(&piece);
  }
  return found;
}

std::optional<OsmOpening> OsmPassages::through(const std::vector<OsmRing>& rings,
                                               const std::string& building) const {
  if (pieces_.empty() || rings.empty() || rings[0].size() < 3) return std::nullopt;
  const std::vector<const Piece*> pieces = pieces_in(rings, building);
  if (pieces.empty()) return std::nullopt;
  const dvec2 origin = rings[0][0];
  Rings passages;
  double top_m = pieces.front()->top_m;
  for (const Piece* piece : pieces) {
    passages.push_back(about(origin, piece->ground));
    top_m = std::max(top_m, piece->top_m);
  }
  std::optional<OsmOpening> opening = cut_open(rings, passages, origin);
  if (!opening) {
    city_.warn(fmt::format("{}: its outline and its passages cross too often; it is drawn without passages",
                           building));
    return std::nullopt;
  }
  if (!(triangles_area_m2(opening->ceiling) > smallest_m2)) return std::nullopt;
  opening->top_m = top_m;
  return opening;
}

}  // namespace parvis::scene
