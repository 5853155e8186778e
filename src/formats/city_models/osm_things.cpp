#include "formats/city_models/osm_things.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "formats/city_models/osm_land.h"
#include "formats/city_models/osm_measures.h"
#include "formats/city_models/osm_segments.h"
#include "formats/city_models/osm_shapes.h"
#include "land/roads/places_on_map.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double row_step_m = 8.0;      // between the trees of a row
constexpr double lowest_crown_m = 1.3;  // `greenery` takes what is lower for ground
constexpr double gauge_m = 1.435, rail_width_m = 0.07, rail_height_m = 0.15, ballast_half_m = 1.7;
constexpr double ballast_lift_m = 0.03;
constexpr double groove_lift_m = 0.085;  // of a tram's rails: over the asphalt that paving lays
constexpr double deck_m = 0.9, bridge_parapet_m = 1.0, parapet_width_m = 0.25;
constexpr double beside_track_m = 0.6;
constexpr double below_road_m = 0.02;   // carriageways lie on the deck
constexpr double embankment_run = 1.5;  // per metre of height
constexpr double wall_run = 0.75;       // per metre of height: what is steeper is a wall, no bank
constexpr double covered_m = 0.3;       // below a bank: neighbouring ways that lie so low would be covered

constexpr double thinnest_m = 0.1;  // of what tags give a height or width

LineLook coloured(const char* type, glm::vec3 srgb, CityAssembly& city) {
  CityMaterial material;
  material.diffuse = srgb;
  return {{type, type, ""}, city.add_material(material)};
}

std::vector<dvec3> on_ground(const std::vector<RaisedPoint>& profile, const GroundOnMap& ground) {
  std::vector<dvec3> line;
  line.reserve(profile.size());
  for (const RaisedPoint& point : profile)
    line.emplace_back(point.place, point.above_m + (ground ? ground(point.place) : 0.0));
  return line;
}

bool has_needles(const OsmTags& tags) { return tag(tags, "leaf_type") == "needleleaved"; }

/// The tree's kind as the map names it, the most exact tag first. Needles are named beside the species: there
/// are more genera of conifers than anybody lists.
std::string species_of(const OsmTags& tags) {
  for (const char* key : {"species", "genus", "leaf_type"})
    if (const std::string& value = tag(tags, key); !value.empty())
      return has_needles(tags) && value != "needleleaved" ? value + " needleleaved" : value;
  return "";
}

/// Trees that stand by themselves and in rows.
class Trees {
 public:
  Trees(const GroundOnMap& ground, const OsmTrenches& trenches, const RaisedWays& raised, CityAssembly& city)
      : ground_(ground), trenches_(trenches), raised_(raised), city_(city) {}

  /// Adds one, unless the ground is open below it or a bridge leads through its crown.
  void add(dvec2 foot, double usual_m, const OsmTags& tags) {
    const double height_m = metres_within(tags, "height", thinnest_m, 60.0, usual_m);
    if (trenches_.holds(foot)) return;
    if (raised_.are_near(foot, crown_share * height_m)) return static_cast<void>(++below_bridges_);
    add_osm_tree({foot, ground_ ? ground_(foot) : 0.0}, height_m, species_of(tags), has_needles(tags), city_);
  }

  /// Warns of those that bridges leave no room.
  void report() const {
    if (below_bridges_ > 0)
      city_.warn(
          fmt::format("{} trees would grow through bridges or ramps; they are left out", below_bridges_));
  }

 private:
  const GroundOnMap& ground_;
  const OsmTrenches& trenches_;
  const RaisedWays& raised_;
  CityAssembly& city_;
  int below_bridges_ = 0;
};

/// Points of roads, by cells of the plan.
class RoadPoints {
 public:
  /// A point of one of the roads.
  struct Point {
    std::size_t road, index;
  };

  explicit RoadPoints(const std::vector<Road>& roads) : roads_(roads) {
    for (std::size_t road = 0; road < roads.size(); ++road)
      for (std::size_t i = 0; i < roads[road].path.size(); ++i)
        cells_[cell_of(dvec2(roads[road].path[i]))].push_back({road, i});
  }

  /// The last point, of the first road that has one, so near to a spot; `near_m` is at most a cell.
  std::optional<Point> near(dvec2 spot, double near_m) const {
    std::optional<Point> best;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const auto cell = cells_.find(cell_of(spot + cell_m * dvec2(x, y)));
        if (cell == cells_.end()) continue;
        for (const Point& point : cell->second) {
          const bool is_better =
              !best || point.road < best->road || (point.road == best->road && point.index > best->index);
          if (is_better && glm::distance(dvec2(roads_[point.road].path[point.index]), spot) < near_m)
            best = point;
        }
      }
    return best;
  }

 private:
  static constexpr double cell_m = 1.0;
  static std::pair<int, int> cell_of(dvec2 p) {
    return {int(std::floor(p.x / cell_m)), int(std::floor(p.y / cell_m))};
  }

  const std::vector<Road>& roads_;
  std::map<std::pair<int, int>, std::vector<Point>> cells_;
};

/// The same for the same tree: 7 to 11 m.
double usual_tree_m(OsmId id) { return 7.0 + 0.5 * double(std::uint64_t(id) * 2654435761u % 9); }

/// Paint where people cross: pieces side by side across the carriageway, in one row or two.
struct CrossingPaint {
  double piece_m, gap_m;  ///< across the road; no gap: one line from kerb to kerb
  double length_m;        ///< along the road
  double apart_m;         ///< of each of two rows from the middle; 0: one row
};

/// Nothing for what is no crossing or has no paint. crossing:markings says which; stripes stand where a
/// crossing is marked and nothing says how. Signals in most towns stand beside stripes or lines.
std::optional<CrossingPaint> paint_of(const OsmTags& tags) {
  constexpr CrossingPaint stripes{0.5, 0.5, 3.0, 0.0}, lines{1.0, 0.0, 0.15, 1.5},
      dashes{0.5, 0.5, 0.15, 1.5}, dots{0.2, 0.4, 0.2, 1.5};
  if (tag(tags, "highway") != "crossing") return std::nullopt;
  const std::string &kind = tag(tags, "crossing"), &markings = tag(tags, "crossing:markings");
  if (markings == "no" || markings == "surface") return std::nullopt;
  if (markings.starts_with("lines")) return lines;
  if (markings.starts_with("dashes")) return dashes;
  if (markings.starts_with("dots")) return dots;
  const bool is_marked = kind == "zebra" || kind == "marked" || kind == "uncontrolled" ||
                         kind == "traffic_signals" || tag(tags, "crossing_ref") == "zebra" ||
                         !markings.empty();
  return is_marked ? std::optional(stripes) : std::nullopt;
}

bool is_row(const OsmWay& way) { return tag(way.tags, "natural") == "tree_row"; }

/// Distance between the trees of rows: farther than usual where there would be too many.
double step_in_rows(const OsmFile& osm, const OsmPlaces& place, CityAssembly& city) {
  double length_m = 0.0;
  for (const OsmWay& way : osm.ways)
    for (std::size_t i = 0; is_row(way) && i + 1 < way.nodes.size(); ++i)
      if (const auto a = place(way.nodes[i]), b = place(way.nodes[i + 1]); a && b)
        length_m += glm::distance(*a, *b);
  const double step_m = std::max(row_step_m, length_m / double(max_row_trees));
  if (step_m > row_step_m)
    city.warn(fmt::format(
        "its rows of trees are {:.0f} km long: their trees stand {:.0f} m apart; cut out the part of the map "
        "that you need for denser ones",
        1e-3 * length_m, step_m));
  return step_m;
}

void add_row(const OsmWay& row, double step_m, const OsmPlaces& place, Trees& trees) {
  double left_m = 0.0;  // until the next tree
  int count = 0;
  for (std::size_t i = 0; i + 1 < row.nodes.size(); ++i) {
    const auto a = place(row.nodes[i]), b = place(row.nodes[i + 1]);
    if (!a || !b) continue;
    const double length_m = glm::distance(*a, *b);
    double at_m = left_m;
    while (at_m <= length_m) {
      trees.add(glm::mix(*a, *b, length_m > 0.0 ? at_m / length_m : 0.0), usual_tree_m(row.id + ++count),
                row.tags);
      at_m += step_m;
    }
    left_m = at_m - length_m;
  }
}

/// A strip of ground along a way: half its width, and heights above the ground at both ends of the segment.
struct Strip {
  double half_m, from_m, to_m;
};
using Strips = OsmSegments<Strip>;

/// How far a bank may reach from an edge, `above_m` over the ground, in a direction of unit length: to its
/// foot, or to the next way that it would cover.
double room_for_bank(const Strips& strips, dvec2 edge, dvec2 out, double above_m) {
  double run_m = embankment_run * above_m;
  strips.each_near(edge, edge + out * run_m, [&](const Strips::Segment& strip) {
    const double length_m = glm::distance(strip.a, strip.b);
    if (length_m <= 0.0) return true;
    const dvec2 along = (strip.b - strip.a) / length_m, across(-along.y, along.x);
    double enters_m = 0.0, leaves_m = run_m;  // where the ray runs over the strip
    const auto clip = [&](double at, double per_m, double low, double high) {
      if (std::abs(per_m) < 1e-9) {
        if (at < low || at > high) leaves_m = -1.0;
        return;
      }
      const double a = (low - at) / per_m, b = (high - at) / per_m;
      enters_m = std::max(enters_m, std::min(a, b)), leaves_m = std::min(leaves_m, std::max(a, b));
    };
    const dvec2 from = edge - strip.a;
    clip(glm::dot(from, across), glm::dot(out, across), -strip.owner.half_m, strip.owner.half_m);
    clip(glm::dot(from, along), glm::dot(out, along), 0.0, length_m);
    if (enters_m > leaves_m) return true;
    const double share = (glm::dot(from, along) + enters_m * glm::dot(out, along)) / length_m;
    const double strip_m = glm::mix(strip.owner.from_m, strip.owner.to_m, share);
    if (strip_m < above_m - enters_m / embankment_run - covered_m) run_m = std::min(run_m, enters_m);
    return true;
  });
  return run_m;
}

/// A bank from the edge of a raised way down to the ground, on one side; a wall where a way lies beside it.
void add_slope(const std::vector<dvec3>& edge, const std::vector<dvec3>& other,
               const std::vector<double>& above_m, const Strips& strips, const LineLook& wall,
               const LineLook& bank, CityAssembly& city) {
  std::vector<dvec3> feet;
  std::vector<bool> is_wall;
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const dvec2 out = glm::normalize(dvec2(edge[i] - other[i]));
    const double run_m = room_for_bank(strips, dvec2(edge[i]), out, above_m[i]);
    feet.emplace_back(dvec2(edge[i]) + out * run_m, edge[i].z - above_m[i]);
    is_wall.push_back(run_m < wall_run * above_m[i]);
  }
  for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
    const LineLook& look = is_wall[i] || is_wall[i + 1] ? wall : bank;
    add_polygon({edge[i], edge[i + 1], feet[i + 1]}, look, city);
    add_polygon({edge[i], feet[i + 1], feet[i]}, look, city);
  }
}

/// A ramp with points between its own: neighbours begin and end anywhere.
std::vector<RaisedPoint> divided(const std::vector<RaisedPoint>& points, double step_m) {
  std::vector<RaisedPoint> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.push_back(points[i]);
    if (i + 1 == points.size()) break;
    const int steps = int(std::ceil(glm::distance(points[i].place, points[i + 1].place) / step_m));
    for (int k = 1; k < steps; ++k) {
      const double share = double(k) / double(steps);
      all.push_back({glm::mix(points[i].place, points[i + 1].place, share),
                     glm::mix(points[i].above_m, points[i + 1].above_m, share)});
    }
  }
  return all;
}

/// The part of a ramp that is raised, as a dam with sloping sides and closed ends.
void add_embankment(const std::vector<RaisedPoint>& ramp, const GroundOnMap& ground, double half_m,
                    const Strips& strips, const LineLook& top, const LineLook& slope, CityAssembly& city) {
  constexpr double step_m = 6.0;
  const std::vector<RaisedPoint> points = divided(ramp, step_m);
  const std::vector<dvec3> line = on_ground(points, ground);
  const Sides sides = sides_of(line, -half_m, half_m, -below_road_m);
  if (sides.left.size() != points.size()) return;  // points that coincide: no length
  std::vector<double> above_m;
  above_m.reserve(points.size());
  for (const RaisedPoint& point : points) above_m.push_back(point.above_m);
  add_band(sides, top, city);
  add_slope(sides.right, sides.left, above_m, strips, top, slope, city);
  add_slope(sides.left, sides.right, above_m, strips, top, slope, city);
}

/// A wall across the way from its deck down to the ground, as wide as the embankment behind it.
void add_abutment(dvec3 at, dvec2 along, double half_m, double above_m, const Strips& strips,
                  const LineLook& stone, CityAssembly& city) {
  const dvec2 aside(along.y, -along.x);
  const auto foot_m = [&](dvec2 out) {
    return half_m + room_for_bank(strips, dvec2(at) + out * half_m, out, above_m);
  };
  const double top = at.z - below_road_m;
  add_polygon({dvec3(dvec2(at) - aside * foot_m(-aside), at.z - above_m),
               dvec3(dvec2(at) + aside * foot_m(aside), at.z - above_m),
               dvec3(dvec2(at) + aside * half_m, top), dvec3(dvec2(at) - aside * half_m, top)},
              stone, city);
}

void add_deck(const std::vector<RaisedPoint>& points, const GroundOnMap& ground, double half_m,
              bool has_parapets, const Strips& strips, const LineLook& deck, CityAssembly& city) {
  const std::vector<dvec3> line = on_ground(points, ground);
  if (line.size() < 2) return;
  add_block(sides_of(line, -half_m, half_m, -below_road_m), deck_m, deck, city);
  for (const double side : {-1.0, 1.0}) {
    if (!has_parapets) break;
    const double outer_m = side * half_m, inner_m = side * (half_m - parapet_width_m);
    add_block(sides_of(line, std::min(outer_m, inner_m), std::max(outer_m, inner_m),
                       bridge_parapet_m - below_road_m),
              bridge_parapet_m, deck, city);
  }
  const std::size_t last = line.size() - 1;
  add_abutment(line[0], glm::normalize(dvec2(line[1] - line[0])), half_m, points[0].above_m, strips, deck,
               city);
  add_abutment(line[last], glm::normalize(dvec2(line[last] - line[last - 1])), half_m, points[last].above_m,
               strips, deck, city);
}

/// The width of a way's deck to either side of its middle line.
struct DeckWidth {
  double half_m = 0.0;  ///< 0: it needs no deck
  bool is_of_street = false;
};

DeckWidth deck_width_of(const OsmWay& way, const std::function<double(const OsmWay&)>& half_carriageway_m) {
  if (const double half_m = half_carriageway_m(way); half_m > 0.0)
    return {half_m + beside_carriageway_m, true};
  if (is_rail(way.tags)) return {ballast_half_m + beside_track_m, false};
  const double half_m = half_path_m(way.tags);
  return {half_m > 0.0 ? half_m + parapet_width_m : 0.0, false};
}

/// Decks of streets, by which trams and paths go that maps have as ways of their own.
class StreetDecks {
 public:
  void add(const std::vector<RaisedPoint>& points, double half_m) {
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      segments_.add(points[i].place, points[i + 1].place, half_m);
  }
  /// Whether one lies under, or right beside, the middle of a deck.
  bool carry(const std::vector<RaisedPoint>& points, double half_m) const {
    if (points.size() < 2) return false;
    const dvec2 a = points[points.size() / 2 - 1].place, b = points[points.size() / 2].place;
    const dvec2 middle = 0.5 * (a + b), along = b - a;
    const double length_m = glm::length(along);
    if (length_m <= 0.0) return false;
    const dvec2 aside = dvec2(along.y, -along.x) / length_m * max_aside_m;
    bool is_carried = false;
    segments_.each_near(middle - aside, middle + aside, [&](const auto& segment) {
      const dvec2 run = segment.b - segment.a;
      const double square = glm::dot(run, run);
      const double share =
          square > 0.0 ? std::clamp(glm::dot(middle - segment.a, run) / square, 0.0, 1.0) : 0.0;
      const double apart_m = glm::distance(middle, segment.a + share * run);
      const bool is_parallel = std::abs(glm::dot(run, along)) > 0.8 * std::sqrt(square) * length_m;
      is_carried = is_parallel && apart_m < segment.owner + half_m + beside_carriageway_m;
      return !is_carried;
    });
    return is_carried;
  }

 private:
  static constexpr double max_aside_m = 40.0;
  OsmSegments<double> segments_;  ///< with half the width of the deck
};

}  // namespace

/// Trunk and crown as two pyramids, foot to foot.
void add_osm_tree(dvec3 foot, double height_m, const std::string& kind, bool has_needles,
                  CityAssembly& city) {
  const LineLook look{{"tree", "SolitaryVegetationObject", kind}};
  const double radius_m = (has_needles ? 0.18 : 0.25) * height_m,
               crown_m = std::max((has_needles ? 0.2 : 0.35) * height_m, lowest_crown_m + 0.05);
  const auto around = [&](int i, double radius, double up_m) {
    const double angle = 2.0 * 3.14159265358979 * double(i) / 4.0;
    return foot + dvec3(radius * std::cos(angle), radius * std::sin(angle), up_m);
  };
  const dvec3 top = foot + dvec3(0.0, 0.0, height_m),
              base = foot + dvec3(0.0, 0.0, std::max(0.15 * height_m, lowest_crown_m));
  for (int i = 0; i < 4; ++i) {
    add_polygon({around(i, radius_m, crown_m), around(i + 1, radius_m, crown_m), top}, look, city);
    add_polygon({around(i + 1, radius_m, crown_m), around(i, radius_m, crown_m), base}, look, city);
    add_polygon({around(i, 0.12, 0.0), around(i + 1, 0.12, 0.0), base}, look, city);
  }
}

void add_osm_plants_and_barriers(const OsmFile& osm, const OsmPlaces& place, const GroundOnMap& ground,
                                 const OsmTrenches& trenches, const RaisedWays& raised, CityAssembly& city) {
  Trees trees(ground, trenches, raised, city);
  for (const OsmNode& node : osm.tagged_nodes)
    if (tag(node.tags, "natural") == "tree")
      if (const auto foot = place(node.id)) trees.add(*foot, usual_tree_m(node.id), node.tags);
  struct Barrier {
    const char* kind;
    double height_m, width_m;
    glm::vec3 srgb;
  };
  for (const Barrier& barrier :
       {Barrier{"hedge", 1.4, 0.7, {0.24f, 0.34f, 0.16f}}, Barrier{"fence", 1.2, 0.06, {0.33f, 0.3f, 0.26f}},
        Barrier{"wall", 1.8, 0.3, {0.62f, 0.57f, 0.5f}},
        Barrier{"retaining_wall", 1.2, 0.4, {0.6f, 0.58f, 0.54f}},
        Barrier{"city_wall", 6.0, 1.5, {0.6f, 0.55f, 0.47f}}}) {
    const LineLook look = coloured("CityFurniture", barrier.srgb, city);
    for (const OsmWay& way : osm.ways) {
      if (tag(way.tags, "barrier") != barrier.kind || says_yes(way.tags, "building")) continue;
      std::vector<dvec3> line;
      for (const OsmId node : way.nodes)
        if (const auto point = place(node)) line.emplace_back(*point, ground ? ground(*point) : 0.0);
      const double height_m = metres_within(way.tags, "height", thinnest_m, 30.0, barrier.height_m);
      const double half_m = 0.5 * metres_within(way.tags, "width", thinnest_m, 20.0, barrier.width_m);
      add_block(sides_of(line, -half_m, half_m, height_m), height_m, look, city);
    }
  }
  const double step_m = step_in_rows(osm, place, city);
  for (const OsmWay& way : osm.ways)
    if (is_row(way)) add_row(way, step_m, place, trees);
  trees.report();
}

void add_osm_rails(const OsmFile& osm, const OsmRelief& relief, const GroundOnMap& ground,
                   const GroundOnMap& shaped, CityAssembly& city) {
  const LineLook steel = coloured("CityFurniture", {0.36f, 0.33f, 0.31f}, city);
  const LineLook ballast{{"Railway", "Railway", ""}};
  for (const OsmWay& way : osm.ways) {
    const std::string& kind = tag(way.tags, "railway");
    const bool is_tram = kind == "tram";
    const bool is_shown =
        is_tram || kind == "rail" || kind == "light_rail" || kind == "narrow_gauge" || kind == "subway";
    const bool is_left_out = is_underground(way.tags) && (ground || !is_tunnel(way.tags));
    if (!is_shown || is_left_out) continue;
    std::vector<dvec3> line;
    for (const RaisedPoint& point : relief.profile(way)) {
      const GroundOnMap& below = point.above_m == 0.0 ? shaped : ground;
      line.emplace_back(point.place, point.above_m + (below ? below(point.place) : 0.0));
    }
    if (!is_tram) add_band(sides_of(line, -ballast_half_m, ballast_half_m, ballast_lift_m), ballast, city);
    for (const double side : {-0.5, 0.5}) {
      const double middle_m = side * gauge_m, half_m = 0.5 * rail_width_m;
      if (is_tram)
        add_band(sides_of(line, middle_m - half_m, middle_m + half_m, groove_lift_m), steel, city);
      else
        add_block(sides_of(line, middle_m - half_m, middle_m + half_m, ballast_lift_m + rail_height_m),
                  rail_height_m, steel, city);
    }
  }
}

void add_osm_bridges(const OsmFile& osm, const OsmRelief& relief, const GroundOnMap& ground,
                     const std::function<double(const OsmWay&)>& half_width_m, CityAssembly& city) {
  const LineLook deck{{"Bridge", "Bridge", ""}}, top{{"Bridge", "Bridge", ""}};
  const LineLook slope{{"embankment", "PlantCover", "embankment"}};
  StreetDecks streets;
  Strips strips;
  for (const OsmWay& way : osm.ways) {
    const DeckWidth width = deck_width_of(way, half_width_m);
    if (width.half_m <= 0.0 || is_underground(way.tags)) continue;
    const std::vector<RaisedPoint> points = relief.profile(way);
    if (width.is_of_street && is_bridge(way.tags)) streets.add(points, width.half_m);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
      strips.add(points[i].place, points[i + 1].place,
                 {width.half_m, points[i].above_m, points[i + 1].above_m});
  }
  for (const OsmWay& way : osm.ways) {
    const DeckWidth width = deck_width_of(way, half_width_m);
    if (width.half_m <= 0.0 || is_underground(way.tags)) continue;
    const bool is_tram = tag(way.tags, "railway") == "tram";
    const std::vector<RaisedPoint> points = relief.profile(way);
    if (is_bridge(way.tags)) {
      const bool is_carried = !width.is_of_street && streets.carry(points, width.half_m);
      if (!is_tram || !is_carried) add_deck(points, ground, width.half_m, !is_carried, strips, deck, city);
    } else if (!is_tram && (ground || !width.is_of_street)) {  // trams climb in the street, streets on banks
      each_stretch(points, 1.0, [&](const std::vector<RaisedPoint>& raised) {
        add_embankment(raised, ground, width.half_m, strips, top, slope, city);
      });
    }
  }
}

void add_osm_crossings(const OsmFile& osm, const OsmPlaces& place, const std::vector<Road>& roads,
                       const dvec3& origin, CityAssembly& city) {
  constexpr double lift_m = 0.078, near_m = 0.6;
  const LineLook paint = coloured("CityFurniture", {0.86f, 0.86f, 0.84f}, city);
  const RoadPoints points(roads);
  for (const OsmNode& node : osm.tagged_nodes) {
    const std::optional<CrossingPaint> marks = paint_of(node.tags);
    const auto at = marks ? place(node.id) : std::nullopt;
    if (!at) continue;
    const auto point = points.near(*at - dvec2(origin), near_m);
    if (!point || roads[point->road].path.size() < 2) continue;
    const Road& road = roads[point->road];
    const std::size_t found = point->index;
    const std::size_t next = std::min(found + 1, road.path.size() - 1);
    const dvec2 along = glm::normalize(dvec2(road.path[next] - road.path[next - 1]));
    const dvec2 aside(along.y, -along.x);
    const double half_m =
        0.5 * double(road.lane_width_m) * double(road.lanes_each_way + road.lanes_against());
    const double z = origin.z + double(road.path[found].z) + lift_m;
    const double step_m = marks->piece_m + marks->gap_m;
    const double piece_m = marks->gap_m > 0.0 ? marks->piece_m : 2.0 * half_m;
    for (double side = -half_m + 0.5 * marks->gap_m; side + piece_m < half_m + 1e-6; side += step_m) {
      for (const double middle_m : {-marks->apart_m, marks->apart_m}) {
        const dvec2 low = *at + aside * side + along * (middle_m - 0.5 * marks->length_m);
        add_polygon({dvec3(low, z), dvec3(low + aside * piece_m, z),
                     dvec3(low + aside * piece_m + along * marks->length_m, z),
                     dvec3(low + along * marks->length_m, z)},
                    paint, city);
        if (marks->apart_m == 0.0) break;  // one row
      }
      if (marks->gap_m == 0.0) break;
    }
  }
}

void add_osm_signals_and_stops(const OsmFile& osm, const OsmPlaces& place, const std::vector<Road>& roads,
                               const dvec3& origin, const GroundOnMap& ground, Model& model) {
  constexpr double near_m = 0.6;  // signals are nodes of their street
  const RoadPoints points(roads);
  const auto add = [&](std::string_view name, dvec3 at) {
    ModelNode node;
    node.name = name, node.parent = 0, node.translation = at;
    model.nodes.push_back(std::move(node));
  };
  for (const OsmNode& node : osm.tagged_nodes) {
    const std::string &highway = tag(node.tags, "highway"), &crossing = tag(node.tags, "crossing");
    const bool has_signals = highway == "traffic_signals" ||
                             (highway == "crossing" &&
                              (crossing == "traffic_signals" || tag(node.tags, "crossing:signals") == "yes"));
    const bool is_stop = highway == "bus_stop" ||
                         (tag(node.tags, "public_transport") == "platform" && tag(node.tags, "bus") == "yes");
    const auto at = has_signals || is_stop ? place(node.id) : std::nullopt;
    if (!at) continue;
    const dvec2 here = *at - dvec2(origin);
    if (is_stop) add(map_bus_stop_node, dvec3(here, ground ? ground(*at) : 0.0));
    if (const auto point = points.near(here, near_m); has_signals && point)
      add(map_signal_node, dvec3(roads[point->road].path[point->index]));
  }
}

}  // namespace parvis::scene
