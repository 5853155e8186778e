#include "formats/city_models/osm_woods.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "formats/city_models/osm_roads.h"
#include "formats/city_models/osm_segments.h"
#include "formats/city_models/osm_things.h"

namespace parvis::scene {
namespace {

using glm::dvec2;

constexpr double usual_step_m = 7.0;
constexpr double beside_way_m = 2.5, beside_wall_m = 3.0;  // of a trunk
constexpr double path_half_m = 1.0, rail_half_m = 2.5, water_half_m = 2.0;

bool is_wood(const OsmTags& tags) {
  return (tag(tags, "natural") == "wood" || tag(tags, "landuse") == "forest") && !is_underground(tags);
}

/// Repeatable for a cell of the plan: 0..1.
double chance(glm::ivec2 cell, std::uint32_t salt) {
  std::uint32_t hash =
      std::uint32_t(cell.x) * 0x9E3779B1u ^ std::uint32_t(cell.y) * 0x85EBCA77u ^ salt * 0xC2B2AE3Du;
  hash = (hash ^ (hash >> 15u)) * 0x2C1B3C6Du;
  hash = (hash ^ (hash >> 12u)) * 0x297A2D39u;
  return double(hash ^ (hash >> 15u)) / 4294967296.0;
}

/// Calls use(row, from, to) for what lies in the wood of rows of the plan: where the row's middle crosses the
/// outline, the wood begins and ends.
template <class Use>
void each_row(const OsmArea& wood, double step_m, const Use& use) {
  dvec2 low = wood.rings[0][0], high = low;
  for (const dvec2& point : wood.rings[0]) low = glm::min(low, point), high = glm::max(high, point);
  for (int y = int(std::floor(low.y / step_m)); y <= int(std::floor(high.y / step_m)); ++y) {
    const double line = (double(y) + 0.5) * step_m;
    std::vector<double> crossings;
    for (const OsmRing& ring : wood.rings)
      for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++)
        if ((ring[i].y > line) != (ring[k].y > line))
          crossings.push_back(ring[i].x +
                              (ring[k].x - ring[i].x) * (line - ring[i].y) / (ring[k].y - ring[i].y));
    std::ranges::sort(crossings);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) use(y, crossings[i], crossings[i + 1]);
  }
}

/// How many trees so far apart have room. Rows are counted, not areas: outlines that cross themselves have
/// none.
double room_in(const std::vector<OsmArea>& woods, double step_m) {
  double trees = 0.0;
  for (const OsmArea& wood : woods)
    each_row(wood, step_m, [&](int, double from, double to) { trees += (to - from) / step_m; });
  return trees;
}

/// Wider than usual where there would be too many trees.
double step_in(const std::vector<OsmArea>& woods, double trees) {
  double step_m = usual_step_m;
  while (trees > 1.05 * double(max_wood_trees)) {
    step_m *= std::sqrt(trees / double(max_wood_trees));
    trees = room_in(woods, step_m);
  }
  return step_m;
}

/// One tree at most in each square cell of the plan: woods that overlap have each tree once.
class WoodTrees {
 public:
  explicit WoodTrees(double step_m) : step_m_(step_m) {}

  void add(const OsmArea& wood) {
    each_row(wood, step_m_, [&](int y, double from, double to) {
      int x = int(std::ceil(from / step_m_ - 0.5));
      for (; (double(x) + 0.5) * step_m_ < to; ++x) trees_.try_emplace({x, y}, wood.tags);
    });
  }

  /// Takes out the trees nearer to a line than its owner says.
  void keep_off(const OsmSegments<double>& lines) {
    std::erase_if(trees_, [&](const auto& tree) {
      const dvec2 foot = foot_of(tree.first);
      bool is_free = true;
      lines.each_near(foot, foot, [&](const OsmSegments<double>::Segment& line) {
        const dvec2 along = line.b - line.a;
        const double share =
            std::clamp(glm::dot(foot - line.a, along) / std::max(glm::dot(along, along), 1e-9), 0.0, 1.0);
        is_free = glm::distance(foot, line.a + share * along) >= line.owner;
        return is_free;
      });
      return !is_free;
    });
  }

  /// Takes out the trees inside an area.
  void keep_out(const OsmArea& area) {
    dvec2 low = area.rings[0][0], high = low;
    for (const dvec2& point : area.rings[0]) low = glm::min(low, point), high = glm::max(high, point);
    const glm::ivec2 first = glm::ivec2(glm::floor(low / step_m_)), last(glm::floor(high / step_m_));
    for (int x = first.x; x <= last.x; ++x)
      for (auto tree = trees_.lower_bound({x, first.y});
           tree != trees_.end() && tree->first.first == x && tree->first.second <= last.y;)
        tree = is_inside(area, foot_of(tree->first)) ? trees_.erase(tree) : std::next(tree);
  }

  /// Calls use(foot, tags of the wood, cell) for each tree.
  template <class Use>
  void each(const Use& use) const {
    for (const auto& [cell, tags] : trees_) use(foot_of(cell), *tags, glm::ivec2(cell.first, cell.second));
  }

 private:
  using Cell = std::pair<int, int>;

  dvec2 foot_of(Cell of) const {
    const glm::ivec2 cell(of.first, of.second);
    return (dvec2(cell) + 0.5 + 0.7 * (dvec2(chance(cell, 1), chance(cell, 2)) - 0.5)) * step_m_;
  }
  static bool is_inside(const OsmArea& area, dvec2 point) {
    bool is_inside = false;
    for (const OsmRing& ring : area.rings) is_inside ^= holds(ring, point);
    return is_inside;
  }

  double step_m_;
  std::map<Cell, const OsmTags*> trees_;
};

/// Half the width of what runs along a way on the ground; below 0: nothing.
double half_width_m(const OsmWay& way) {
  if (is_underground(way.tags)) return -1.0;
  if (const double half_m = half_carriageway_m(way); half_m > 0.0) return half_m;
  if (says_yes(way.tags, "highway")) return path_half_m;
  if (is_rail(way.tags)) return rail_half_m;
  return says_yes(way.tags, "waterway") ? water_half_m : -1.0;
}

bool is_standing_building(const OsmTags& tags) { return says_yes(tags, "building") && !is_underground(tags); }

/// Where maps often draw no hole in a wood for it.
bool is_clearing(const OsmTags& tags) {
  return is_standing_building(tags) || tag(tags, "natural") == "water" || tag(tags, "amenity") == "parking" ||
         tag(tags, "leisure") == "pitch" || tag(tags, "leisure") == "playground";
}

void keep_free(const OsmFile& osm, const OsmPlaces& place, CityAssembly& city, WoodTrees& trees) {
  OsmSegments<double> lines;
  for (const OsmWay& way : osm.ways) {
    const double half_m = half_width_m(way);
    if (half_m < 0.0) continue;
    for (std::size_t i = 0; i + 1 < way.nodes.size(); ++i)
      if (const auto from = place(way.nodes[i]), to = place(way.nodes[i + 1]); from && to)
        lines.add(*from, *to, half_m + beside_way_m);
  }
  for (const OsmArea& area : OsmAreas(osm, place, city).find(is_clearing, "")) {
    trees.keep_out(area);
    if (!is_standing_building(*area.tags)) continue;
    for (const OsmRing& ring : area.rings)
      for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++)
        lines.add(ring[k], ring[i], beside_wall_m);
  }
  trees.keep_off(lines);
}

}  // namespace

void add_osm_woods(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                   const OsmTrenches& trenches, const RaisedWays& raised, CityAssembly& city) {
  const std::vector<OsmArea> woods = OsmAreas(osm, place, city).find(is_wood, "");
  if (woods.empty()) return;
  const double room = room_in(woods, usual_step_m), step_m = step_in(woods, room);
  if (step_m > usual_step_m)
    city.warn(fmt::format(
        "its woods cover {:.0f} ha: their trees stand {:.0f} m apart; cut out the part of the map "
        "that you need for denser ones",
        1e-4 * room * usual_step_m * usual_step_m, step_m));
  WoodTrees trees(step_m);
  for (const OsmArea& wood : woods) trees.add(wood);
  keep_free(osm, place, city, trees);
  trees.each([&](dvec2 foot, const OsmTags& wood, glm::ivec2 cell) {
    const double height_m = 9.0 + 7.0 * chance(cell, 4);
    if (trenches.holds(foot) || raised.are_near(foot, crown_share * height_m)) return;
    const std::string& leaves = tag(wood, "leaf_type");
    const bool has_needles = leaves == "needleleaved" || (leaves == "mixed" && chance(cell, 3) < 0.5);
    add_osm_tree({foot, ground ? ground(foot) : 0.0}, height_m, has_needles ? "wood needleleaved" : "wood",
                 has_needles, city);
  });
}

}  // namespace parvis::scene
