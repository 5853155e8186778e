#include "land/roads/road_from_polygons.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>

#include "base/bounds.h"
#include "base/median.h"
#include "land/roads/one_way_streets.h"
#include "land/roads/road_network.h"
#include "land/roads/skeleton.h"
#include "scene/data/path.h"

namespace parvis::scene {

namespace {

constexpr float finest_cell_m = 0.5f;
constexpr float max_cells = 16e6f;        // larger places get larger cells
constexpr float polygon_margin_m = 4.0f;  // around the polygons
constexpr float gap_m = 2.0f;             // between surfaces that belong together
constexpr float island_m2 = 150.0f;       // in the carriageway, driven past, not around
constexpr float narrowest_road_m = 2.6f;
constexpr float min_lane_m = 2.35f;      // two cars just pass, a wheel on the pavement
constexpr float kerb_distance_m = 0.3f;  // that lanes leave on each side
constexpr float widest_lane_m = 3.25f;
constexpr float shortest_end_m = 25.0f;   // of a road that ends without meeting another
constexpr float turning_circle_m = 9.0f;  // of a car
constexpr float smoothing_m = 5.0f;       // standard deviation: takes away the steps of the cells
constexpr float tolerance_m = 0.25f;      // of the simplified line

// Words for what vehicles do not use, in the languages of the city models at hand (Dutch BGT, German,
// English).
constexpr std::array not_drivable{"voet",       "fiets", "parkeer", "trap",   "ruiter",  "spoor", "foot",
                                  "pedestrian", "cycle", "parking", "stairs", "steps",   "rail",  "gehweg",
                                  "radweg",     "fussg", "treppe",  "berm",   "sidewalk"};

/// A cell raster that holds all polygons.
Mask empty_mask(std::span<const RoadPolygon* const> polygons) {
  Bounds bounds;
  for (const RoadPolygon* polygon : polygons)
    for (const std::vector<glm::vec3>& ring : polygon->rings)
      for (const glm::vec3& p : ring) bounds.add(p);
  const glm::vec2 size = glm::vec2(bounds.size()) + 2.0f * polygon_margin_m;
  const float cell = std::max(finest_cell_m, std::sqrt(size.x * size.y / max_cells));
  const glm::ivec2 cells(glm::ceil(size / cell));
  return Mask(cells.x, cells.y, cell, glm::vec2(bounds.min) - polygon_margin_m, 0);
}

/// z of a polygon's plane as a function of the plan (Newell's normal); level where it stands upright.
struct GroundPlane {
  glm::vec3 middle{0.0f}, normal{0.0f, 0.0f, 1.0f};

  explicit GroundPlane(const std::vector<glm::vec3>& ring) {
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const glm::vec3 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      middle += a / float(ring.size());
      sum += glm::cross(a - ring[0], b - ring[0]);
    }
    if (std::abs(sum.z) > 0.3f * glm::length(sum) && std::abs(sum.z) > 1e-6f) normal = sum;
  }
  float height_at(glm::vec2 p) const {
    return middle.z - (normal.x * (p.x - middle.x) + normal.y * (p.y - middle.y)) / normal.z;
  }
};

/// The ground: which cells are road, and how high they lie.
struct Ground {
  Mask mask;
  GroundRaster<float> heights_m;  ///< of the cells that polygons cover

  /// Height at a point: of the nearest covered cell.
  float height_at(glm::vec2 point) const {
    const glm::ivec2 centre = mask.cell_at(point);
    for (int reach = 0; reach < 40; ++reach)
      for (int y = centre.y - reach; y <= centre.y + reach; ++y)
        for (int x = centre.x - reach; x <= centre.x + reach; ++x) {
          const bool is_on_edge = std::max(std::abs(x - centre.x), std::abs(y - centre.y)) == reach;
          if (is_on_edge && mask.contains(x, y) && mask.at(x, y)) return heights_m.at(x, y);
        }
    return 0.0f;
  }
};

Ground ground_of(std::span<const RoadPolygon* const> polygons) {
  Ground ground{empty_mask(polygons), {}};
  ground.heights_m = GroundRaster<float>(ground.mask, 0.0f);
  for (const RoadPolygon* polygon : polygons) {
    const GroundPlane plane(polygon->rings.front());
    for (const glm::ivec2 cell : cells_inside(ground.mask, polygon->rings)) {
      ground.mask.at(cell.x, cell.y) = 1;
      ground.heights_m.at(cell.x, cell.y) = plane.height_at(ground.mask.centre_of(cell));
    }
  }
  return ground;
}

/// Points every metre, weighted with their neighbours by a Gaussian; the ends stay.
Path smoothed(const Path& path, float deviation_m) {
  const MeasuredPath measured(path);
  const int count = std::max(2, int(std::round(measured.length())));
  const float step_m = measured.length() / float(count);
  const auto point = [&](int i) {
    // Beyond an end the path goes on as its mirror image through that end: so the ends stay where they are.
    if (i < 0) return 2.0f * measured.at(0.0f) - measured.at(std::min(float(-i) * step_m, measured.length()));
    if (i > count)
      return 2.0f * measured.at(measured.length()) -
             measured.at(std::max(float(2 * count - i) * step_m, 0.0f));
    return measured.at(float(i) * step_m);
  };
  const int reach = int(std::ceil(3.0f * deviation_m / step_m));
  Path result;
  for (int i = 0; i <= count; ++i) {
    glm::vec3 sum(0.0f);
    float weights = 0.0f;
    for (int k = -reach; k <= reach; ++k) {
      const float offset = float(k) * step_m / deviation_m;
      const float weight = std::exp(-0.5f * offset * offset);
      sum += weight * point(i + k), weights += weight;
    }
    result.push_back(sum / weights);
  }
  result.front() = path.front(), result.back() = path.back();  // to the last bit: there roads meet
  return result;
}

/// Leaves out points that lie within `tolerance` of the line that remains (Douglas and Peucker 1973).
void simplify(const Path& path, std::size_t first, std::size_t last, Path& result) {
  std::size_t furthest = first;
  float largest = tolerance_m;
  const glm::vec3 chord = path[last] - path[first];
  for (std::size_t i = first + 1; i < last; ++i) {
    const glm::vec3 away = path[i] - path[first];
    const float fraction =
        std::clamp(glm::dot(away, chord) / std::max(glm::dot(chord, chord), 1e-12f), 0.0f, 1.0f);
    const float distance = glm::length(away - fraction * chord);
    if (distance > largest) largest = distance, furthest = i;
  }
  if (furthest == first) return result.push_back(path[last]);
  simplify(path, first, furthest, result);
  simplify(path, furthest, last, result);
}

/// The middle line of a branch. Within a junction's circle the skeleton bends toward corners: there it goes
/// straight.
Path centre_line(const SkeletonBranch& branch, const Skeleton& skeleton, const Ground& ground) {
  const SkeletonNode &start = skeleton.nodes[std::size_t(branch.start)],
                     &end = skeleton.nodes[std::size_t(branch.end)];
  const float length = branch.length_m();
  const bool is_ring = branch.start == branch.end;
  const auto leave_out = [&](const SkeletonNode& node) {
    return is_ring ? 0.0f : std::min(node.radius_m, 0.3f * length);
  };
  const float from = leave_out(start), to = length - leave_out(end);
  Path path;
  float along = 0.0f;
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    if (i > 0) along += glm::distance(branch.points[i - 1], branch.points[i]);
    const bool is_end = i == 0 || i + 1 == branch.points.size();
    if (is_end || (along >= from && along <= to))
      path.emplace_back(branch.points[i], ground.height_at(branch.points[i]));
  }
  const Path smooth = smoothed(without_repeats(path), smoothing_m);
  Path result{smooth.front()};
  simplify(smooth, 0, smooth.size() - 1, result);
  if (is_ring) result.back() = result.front();
  return without_repeats(result);
}

std::optional<Road> road_of(const SkeletonBranch& branch, const Skeleton& skeleton, const Ground& ground) {
  const float width_m = 2.0f * median(branch.radii_m);
  if (width_m < narrowest_road_m || branch.points.size() < 3) return std::nullopt;
  Road road;
  road.path = centre_line(branch, skeleton, ground);
  road.lanes_each_way = std::clamp(int(0.5f * width_m / 3.0f), 1, 3);
  road.lane_width_m =
      std::min((0.5f * width_m - kerb_distance_m) / float(road.lanes_each_way), widest_lane_m);
  return road.path.size() < 2 ? std::nullopt : std::optional(std::move(road));
}

/// How many roads end at each place. Roads that meet end there to the last bit.
class RoadEnds {
 public:
  explicit RoadEnds(std::span<const Road> roads) {
    for (const Road& road : roads) {
      ++count_[key(road.path.front())];
      if (!is_ring(road)) ++count_[key(road.path.back())];
    }
  }

  /// How many of the road's two ends meet another road, or each other.
  int joined(const Road& road) const {
    if (is_ring(road)) return 2;
    return int(count_.at(key(road.path.front())) > 1) + int(count_.at(key(road.path.back())) > 1);
  }

 private:
  static bool is_ring(const Road& road) { return road.path.front() == road.path.back(); }
  static std::array<float, 3> key(glm::vec3 end) { return {end.x, end.y, end.z}; }

  std::map<std::array<float, 3>, int> count_;
};

/// Removes roads whose ends are too narrow to turn a car in, as long as such ends come up.
std::vector<Road> without_narrow_dead_ends(std::vector<Road> roads) {
  const auto is_trap = [](const Road& road, const RoadEnds& ends) {
    return ends.joined(road) < 2 && 2.0f * half_width_m(road) < turning_circle_m;
  };
  while (std::erase_if(roads, [&, ends = RoadEnds(roads)](const Road& road) { return is_trap(road, ends); }) >
         0)
    continue;
  return roads;
}

bool is_usable(const RoadPolygon& polygon) {
  const auto is_finite = [](const glm::vec3& p) { return std::isfinite(p.x + p.y + p.z); };
  return is_drivable(polygon.function) && !polygon.rings.empty() && polygon.rings.front().size() >= 3 &&
         std::ranges::all_of(polygon.rings,
                             [&](const auto& ring) { return std::ranges::all_of(ring, is_finite); });
}

}  // namespace

bool is_drivable(const std::string& function) {
  std::string lower = function;
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  return std::ranges::none_of(not_drivable,
                              [&](const char* word) { return lower.find(word) != std::string::npos; });
}

std::vector<Road> roads_from_polygons(std::span<const RoadPolygon> polygons) {
  std::vector<const RoadPolygon*> drivable;
  for (const RoadPolygon& polygon : polygons)
    if (is_usable(polygon)) drivable.push_back(&polygon);
  if (drivable.empty()) return {};

  const Ground ground = ground_of(drivable);
  const Skeleton skeleton = skeleton_of(closed(ground.mask, gap_m, island_m2));
  std::vector<Road> roads;
  for (const SkeletonBranch& branch : skeleton.branches)
    if (std::optional<Road> road = road_of(branch, skeleton, ground)) roads.push_back(std::move(*road));

  std::erase_if(roads, [ends = RoadEnds(roads)](const Road& road) {
    return ends.joined(road) < 2 && MeasuredPath(road.path).length() < shortest_end_m;
  });
  std::vector<Road> kept = without_narrow_dead_ends(roads);
  if (kept.empty()) kept = std::move(roads);
  make_narrow_streets_one_way(kept, min_lane_m);
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i].name = fmt::format("road surface {}", i + 1);
  return kept;
}

}  // namespace parvis::scene
