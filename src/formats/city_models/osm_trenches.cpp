#include "formats/city_models/osm_trenches.h"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "formats/city_models/osm_roads.h"
#include "formats/city_models/polygon_crossings.h"
#include "formats/city_models/polygon_triangles.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double beside_road_m = 3.6, beside_rail_m = 2.0;  // of the carriageway, of the track's middle
constexpr double parapet_m = 0.9, wall_m = 0.25;
constexpr double below_way_m = 0.02;  // of a floor: carriageways lie on it
constexpr double wall_step_m = 2.0;   // pieces of walls, each left out where another way leads through
constexpr double dug_m = 0.05;        // what lies less deep is no trench
constexpr double same_edge_m = 0.01;

/// Half the width of a tunnel or trench; 0 for what has none.
double half_trench_m(const OsmWay& way) {
  if (is_rail(way.tags)) return beside_rail_m;
  const double half_m = half_carriageway_m(way);
  return half_m > 0.0 ? half_m + beside_road_m : 0.0;
}

std::vector<dvec3> line_of(const std::vector<RaisedPoint>& points) {
  std::vector<dvec3> line;
  for (const RaisedPoint& point : points) line.emplace_back(point.place, point.above_m);
  return line;
}

/// Calls use(stretch, half width) for all parts of open ways that lie below the ground.
template <class Use>
void each_trench(const OsmFile& osm, const OsmRelief& relief, const Use& use) {
  for (const OsmWay& way : osm.ways) {
    const double half_m = half_trench_m(way);
    if (half_m <= 0.0 || is_underground(way.tags) || is_bridge(way.tags)) continue;
    each_stretch(relief.profile(way), -1.0,
                 [&](const std::vector<RaisedPoint>& stretch) { use(stretch, half_m); });
  }
}

/// Open ways below the ground, by cells of the plan: walls stop where another way leads through.
class OpenWays {
 public:
  void add(dvec2 a, dvec2 b, double half_m, const void* way) {
    const dvec2 low = glm::floor((glm::min(a, b) - half_m) / cell_m),
                high = glm::floor((glm::max(a, b) + half_m) / cell_m);
    for (double y = low.y; y <= high.y; ++y)
      for (double x = low.x; x <= high.x; ++x) cells_[key({x, y})].push_back({a, b, half_m, way});
  }

  /// True if a way other than `way` leads over the point.
  bool lead_over(dvec2 point, const void* way) const {
    const auto cell = cells_.find(key(glm::floor(point / cell_m)));
    return cell != cells_.end() && std::ranges::any_of(cell->second, [&](const Segment& segment) {
             if (segment.way == way) return false;
             const dvec2 along = segment.b - segment.a;
             const double share = glm::dot(point - segment.a, along) / std::max(glm::dot(along, along), 1e-9);
             return share > 0.0 && share < 1.0 &&
                    glm::distance(point, segment.a + share * along) < segment.half_m - wall_m - same_edge_m;
           });
  }

 private:
  static constexpr double cell_m = 20.0;
  struct Segment {
    dvec2 a, b;
    double half_m;
    const void* way;
  };
  static std::uint64_t key(dvec2 cell) {
    return std::uint64_t(std::uint32_t(std::int64_t(cell.x))) << 32u | std::uint32_t(std::int64_t(cell.y));
  }
  std::unordered_map<std::uint64_t, std::vector<Segment>> cells_;
};

/// The line with points between its own, at most `wall_step_m` apart.
std::vector<dvec3> in_steps(const std::vector<dvec3>& line) {
  std::vector<dvec3> fine;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const dvec3 next = line[std::min(i + 1, line.size() - 1)];
    const int steps = std::max(1, int(std::ceil(glm::distance(dvec2(line[i]), dvec2(next)) / wall_step_m)));
    for (int k = 0; k < (i + 1 < line.size() ? steps : 1); ++k)
      fine.push_back(glm::mix(line[i], next, double(k) / double(steps)));
  }
  return fine;
}

dvec3 at_height(dvec3 p, double z) { return {p.x, p.y, z}; }

struct Looks {
  LineLook concrete{{"tunnel", "Tunnel", ""}};
  LineLook floor{{"tunnel", "Road", "tunnel"}}, ramp{{"ramp", "Road", "ramp"}};
};

/// A retaining wall from the floor to a parapet above the ground, on one side of a trench.
void add_trench_wall(const std::vector<dvec3>& inner, const std::vector<dvec3>& outer, bool is_left,
                     const OpenWays& ways, const void* way, const LineLook& look, CityAssembly& city) {
  const auto quad = [&](dvec3 a, dvec3 b, dvec3 c, dvec3 d) {
    is_left ? add_polygon({a, b, c, d}, look, city) : add_polygon({d, c, b, a}, look, city);
  };
  for (std::size_t i = 0; i + 1 < inner.size(); ++i) {
    if (ways.lead_over(0.5 * dvec2(inner[i] + inner[i + 1]), way)) continue;
    const dvec3 a = inner[i], b = inner[i + 1], c = outer[i], d = outer[i + 1];
    quad(a, b, at_height(b, parapet_m), at_height(a, parapet_m));
    quad(at_height(a, parapet_m), at_height(b, parapet_m), at_height(d, parapet_m), at_height(c, parapet_m));
    quad(at_height(c, parapet_m), at_height(d, parapet_m), at_height(d, 0.0), at_height(c, 0.0));
  }
  const std::size_t last = inner.size() - 1;  // ends that are seen above the ground
  for (const std::size_t i : {std::size_t(0), last})
    add_polygon({at_height(inner[i], std::min(inner[i].z, 0.0)), at_height(outer[i], 0.0),
                 at_height(outer[i], parapet_m), at_height(inner[i], parapet_m)},
                look, city);
}

void add_trench(const std::vector<RaisedPoint>& stretch, double half_m, const OpenWays& ways,
                const Looks& looks, CityAssembly& city) {
  const std::vector<dvec3> line = line_of(stretch);
  add_band(sides_of(line, -half_m, half_m, -below_way_m), looks.ramp, city);
  const Sides outer = sides_of(in_steps(line), -half_m, half_m, 0.0),
              inner = sides_of(in_steps(line), -half_m + wall_m, half_m - wall_m, 0.0);
  if (inner.left.empty()) return;
  add_trench_wall(inner.left, outer.left, true, ways, &stretch, looks.concrete, city);
  add_trench_wall(inner.right, outer.right, false, ways, &stretch, looks.concrete, city);
}

/// Adds a wall across the end of a tunnel: above its mouth up to a parapet, or whole where it leads nowhere.
void add_portal(dvec3 end, dvec2 inward, double half_m, bool is_open, const LineLook& look,
                CityAssembly& city) {
  const dvec2 aside(inward.y, -inward.x);
  const double low = is_open ? end.z + OsmRelief::tunnel_clearance_m : end.z - below_way_m,
               high = is_open ? parapet_m : end.z + OsmRelief::tunnel_clearance_m;
  const dvec2 left = dvec2(end) - half_m * aside, right = dvec2(end) + half_m * aside;
  add_polygon({{left, low}, {right, low}, {right, high}, {left, high}}, look, city);
  if (!is_open) return;
  const dvec2 back = wall_m * inward;
  add_polygon({{left, parapet_m}, {right, parapet_m}, {right + back, parapet_m}, {left + back, parapet_m}},
              look, city);
  add_polygon({{right + back, 0.0}, {left + back, 0.0}, {left + back, parapet_m}, {right + back, parapet_m}},
              look, city);
}

void add_tunnel(const OsmWay& way, const std::vector<dvec3>& line, const std::set<OsmId>& open_nodes,
                const std::unordered_map<OsmId, int>& tunnels_at, const Looks& looks, CityAssembly& city) {
  const double half_m = half_trench_m(way);
  const Sides foot = sides_of(line, -half_m, half_m, -below_way_m),
              top = sides_of(line, -half_m, half_m, OsmRelief::tunnel_clearance_m);
  if (foot.left.size() < 2) return;
  add_band(foot, looks.floor, city);
  for (std::size_t i = 0; i + 1 < foot.left.size(); ++i) {
    add_polygon({foot.left[i], foot.left[i + 1], top.left[i + 1], top.left[i]}, looks.concrete, city);
    add_polygon({foot.right[i + 1], foot.right[i], top.right[i], top.right[i + 1]}, looks.concrete, city);
    add_polygon({top.left[i], top.left[i + 1], top.right[i + 1]}, looks.concrete, city);
    add_polygon({top.left[i], top.right[i + 1], top.right[i]}, looks.concrete, city);
  }
  const auto close = [&](OsmId node, dvec3 end, dvec3 next) {
    const bool is_open = open_nodes.count(node) != 0;
    if (is_open || tunnels_at.at(node) < 2)
      add_portal(end, glm::normalize(dvec2(next) - dvec2(end)), half_m, is_open, looks.concrete, city);
  };
  close(way.nodes.front(), line.front(), line[1]);
  close(way.nodes.back(), line.back(), line[line.size() - 2]);
}

std::vector<std::vector<dvec3>> levelled(const OsmRing& ring, double z) {
  std::vector<std::vector<dvec3>> rings(1);
  for (const dvec2& point : ring) rings[0].emplace_back(point, z);
  return rings;
}

}  // namespace

OsmTrenches::OsmTrenches(const OsmFile& osm, const OsmRelief& relief) {
  each_trench(osm, relief, [&](const std::vector<RaisedPoint>& stretch, double half_m) {
    const Sides sides = sides_of(line_of(stretch), -half_m, half_m, 0.0);
    for (std::size_t i = 0; i + 1 < sides.left.size(); ++i) {
      Piece piece{
          {dvec2(sides.right[i]), dvec2(sides.right[i + 1]), dvec2(sides.left[i + 1]), dvec2(sides.left[i])},
          {},
          {}};
      if (area_m2(piece.ring) < 0.0) std::ranges::reverse(piece.ring);
      piece.low = piece.high = piece.ring[0];
      for (const dvec2& point : piece.ring)
        piece.low = glm::min(piece.low, point), piece.high = glm::max(piece.high, point);
      pieces_.push_back(std::move(piece));
    }
  });
}

bool OsmTrenches::holds(dvec2 point) const {
  return std::ranges::any_of(pieces_, [&](const Piece& piece) {
    return glm::all(glm::greaterThanEqual(point, piece.low)) &&
           glm::all(glm::lessThanEqual(point, piece.high)) && scene::holds(piece.ring, point);
  });
}

void OsmTrenches::add_level(const std::vector<std::vector<dvec3>>& rings, const LineLook& look,
                            CityAssembly& city) const {
  const auto add = [&](std::vector<std::vector<dvec3>> surface_rings) {
    CitySurface surface;
    surface.rings = std::move(surface_rings);
    surface.material = look.material;
    city.add(look.object, surface);
  };
  if (rings.empty() || rings[0].size() < 3 || empty()) return add(rings);
  dvec2 low(rings[0][0]), high(rings[0][0]);
  for (const dvec3& point : rings[0]) low = glm::min(low, dvec2(point)), high = glm::max(high, dvec2(point));
  std::vector<std::vector<dvec3>> cut = rings;
  for (const Piece& piece : pieces_)
    if (glm::all(glm::lessThan(piece.low, high)) && glm::all(glm::greaterThan(piece.high, low))) {
      cut.push_back(levelled(piece.ring, rings[0][0].z).front());
      std::ranges::reverse(cut.back());
    }
  if (cut.size() == rings.size()) return add(rings);
  // About the first point, for far coordinates would cost crossings their digits.
  const dvec3 first = rings[0][0];
  for (std::vector<dvec3>& ring : cut)
    for (dvec3& point : ring) point -= first;
  if (!can_be_triangulated(cut, {0.0, 0.0, 1.0})) {
    city.warn(fmt::format("{} trenches of tunnels lead through one area; it covers them",
                          cut.size() - rings.size()));
    return add(rings);
  }
  std::vector<dvec3> points;
  const std::vector<std::uint32_t> triangles = triangulated(cut, {0.0, 0.0, 1.0}, points, Inside::positive);
  for (std::size_t i = 0; i + 2 < triangles.size(); i += 3)
    add({{points[triangles[i]] + first, points[triangles[i + 1]] + first, points[triangles[i + 2]] + first}});
}

void add_osm_tunnels(const OsmFile& osm, const OsmRelief& relief, CityAssembly& city) {
  const Looks looks;
  std::vector<std::pair<std::vector<RaisedPoint>, double>> trenches;
  each_trench(osm, relief, [&](const std::vector<RaisedPoint>& stretch, double half_m) {
    trenches.emplace_back(stretch, half_m);
  });
  OpenWays ways;
  for (const auto& [stretch, half_m] : trenches)
    for (std::size_t i = 0; i + 1 < stretch.size(); ++i)
      ways.add(stretch[i].place, stretch[i + 1].place, half_m, &stretch);
  for (const auto& [stretch, half_m] : trenches) add_trench(stretch, half_m, ways, looks, city);

  std::set<OsmId> open_nodes;
  std::unordered_map<OsmId, int> tunnels_at;
  for (const OsmWay& way : osm.ways) {
    if (half_trench_m(way) <= 0.0 || way.nodes.empty()) continue;
    if (is_tunnel(way.tags))
      ++tunnels_at[way.nodes.front()], ++tunnels_at[way.nodes.back()];
    else if (!is_underground(way.tags))
      open_nodes.insert(way.nodes.begin(), way.nodes.end());
  }
  for (const OsmWay& way : osm.ways) {
    if (!is_tunnel(way.tags)) continue;
    const std::vector<dvec3> line = line_of(relief.profile(way));
    const bool is_dug = std::ranges::any_of(line, [](const dvec3& point) { return point.z < -dug_m; });
    if (is_dug && line.size() >= 2) add_tunnel(way, line, open_nodes, tunnels_at, looks, city);
  }
}

}  // namespace parvis::scene
