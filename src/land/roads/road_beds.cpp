#include "land/roads/road_beds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "land/heights/city_surfaces.h"
#include "land/heights/ground_heights.h"
#include "land/roads/paving.h"
#include "land/roads/road_network.h"
#include "scene/data/path.h"
#include "scene/data/surroundings.h"

namespace parvis::scene {
namespace {

constexpr float shoulder_m = 1.0f;      // of earth beside what is paved, so that slopes begin beyond it
constexpr float bed_step_m = 10.0f;     // between points of a bed
constexpr float lies_on_m = 0.05f;      // what lies so much higher than terrain covers it
constexpr float below_cover_m = 0.15f;  // of terrain that other ground covers: both are drawn to centimetres
constexpr float steepest = 0.7f;        // cosine of 45 degrees: what is steeper is no ground
constexpr float turn_step_m = 4.0f;     // between points of a turn: 30 cm off an arc of 6.5 m
constexpr float min_turn_sine = 0.34f;  // 20 degrees: less stays within the beds
constexpr float bed_cell_m = 16.0f;
constexpr float farthest_bed_cell = 1e8f;  // meshes may reach farther than cells have numbers
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// A point of a road's middle line, with the ground that is found below or above it.
struct Sample {
  glm::vec3 position;
  float terrain_m = unknown, other_m = unknown;
  bool is_covered = false;  ///< far above lies a ceiling, a roof or the ground over a tunnel
};

/// The kind of ground that a part is.
enum class GroundKind { none, terrain, other, deck, cover };

GroundKind ground_of(const std::string& object, Terrain terrain) {
  if (terrain_of(object) == terrain) return GroundKind::terrain;
  if (object.starts_with("Bridge")) return GroundKind::deck;
  if (is_ground(object)) return GroundKind::other;
  const bool may_cover = object.starts_with("Tunnel") || object.starts_with("Roof") ||
                         object.starts_with("OuterCeiling");  // trees and bridges leave a trench open
  return may_cover ? GroundKind::cover : GroundKind::none;
}

/// Samples by cells of the plan.
class Samples {
 public:
  explicit Samples(std::vector<Sample>& samples) : samples_(samples) {
    for (std::size_t i = 0; i < samples.size(); ++i)
      cells_[key(cell_of(glm::vec2(samples[i].position)))].push_back(i);
  }

  void note(glm::vec3 a, glm::vec3 b, glm::vec3 c, GroundKind ground) {
    const glm::vec3 normal = glm::cross(b - a, c - a);
    if (!(std::abs(normal.z) > steepest * glm::length(normal)) || normal.z == 0.0f) return;
    const glm::ivec2 low = cell_of(glm::min(glm::vec2(a), glm::min(glm::vec2(b), glm::vec2(c)))),
                     high = cell_of(glm::max(glm::vec2(a), glm::max(glm::vec2(b), glm::vec2(c))));
    const glm::i64vec2 size = glm::i64vec2(high - low) + std::int64_t(1);
    if (size.x * size.y > std::int64_t(cells_.size())) {  // of a triangle as large as a town
      for (const auto& [cell, indices] : cells_)
        for (const std::size_t i : indices) note_at(samples_[i], a, b, c, normal, ground);
      return;
    }
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if (const auto cell = cells_.find(key({x, y})); cell != cells_.end())
          for (const std::size_t i : cell->second) note_at(samples_[i], a, b, c, normal, ground);
  }

 private:
  static std::uint64_t key(glm::ivec2 cell) {
    return std::uint64_t(std::uint32_t(cell.x)) << 32u | std::uint32_t(cell.y);
  }
  static glm::ivec2 cell_of(glm::vec2 point) {
    return glm::ivec2(glm::clamp(glm::floor(point / bed_cell_m), -farthest_bed_cell, farthest_bed_cell));
  }

  static void note_at(Sample& sample, glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 normal,
                      GroundKind ground) {
    const glm::vec2 p(sample.position);
    const auto side = [&](glm::vec3 from, glm::vec3 to) {
      return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
    };
    const float ab = side(a, b), bc = side(b, c), ca = side(c, a);
    if (std::min({ab, bc, ca}) < 0.0f && std::max({ab, bc, ca}) > 0.0f) return;
    const float height_m = a.z - (normal.x * (p.x - a.x) + normal.y * (p.y - a.y)) / normal.z;
    const bool may_cover = ground == GroundKind::cover || ground == GroundKind::other;
    if (may_cover && height_m > sample.position.z + ground_reach_m) sample.is_covered = true;
    if (ground == GroundKind::cover) return;
    const float near_m = ground == GroundKind::deck ? deck_reach_m : ground_reach_m;
    float& known_m = ground == GroundKind::terrain ? sample.terrain_m : sample.other_m;
    if (std::abs(height_m - sample.position.z) < near_m && !(known_m >= height_m)) known_m = height_m;
  }

  std::vector<Sample>& samples_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> cells_;
};

/// The path's points, with others between them.
void add_samples(const std::vector<glm::vec3>& path, std::vector<Sample>& samples) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const glm::vec3 next = path[std::min(i + 1, path.size() - 1)];
    const int steps =
        std::max(1, int(std::ceil(glm::distance(glm::vec2(path[i]), glm::vec2(next)) / bed_step_m)));
    for (int k = 0; k < (i + 1 < path.size() ? steps : 1); ++k)
      samples.push_back({glm::mix(path[i], next, float(k) / float(steps))});
  }
}

/// Adds the places at both edges of the bed, for each of the samples from `first` on. Returns the index of
/// the first of them: the edges of sample k are 2 (k - first) and one more beyond it.
std::size_t add_edges(std::size_t first, float half_m, std::vector<Sample>& samples) {
  const std::size_t end = samples.size();
  for (std::size_t k = first; k < end; ++k) {
    const glm::vec3 along =
        samples[std::min(k + 1, end - 1)].position - samples[k > first ? k - 1 : first].position;
    const bool has_direction = glm::length(glm::vec2(along)) > 0.0f;
    const glm::vec3 aside = has_direction ? half_m * right_of(along) : glm::vec3(0.0f);
    for (const float side : {-1.0f, 1.0f}) samples.push_back({samples[k].position + side * aside});
  }
  return end;
}

/// Whether the ground lies so far below other ground that nothing of it is to be cut.
bool is_below_cover(const Sample& sample) { return sample.terrain_m < sample.other_m - below_cover_m; }

/// Trenches are dug through generated ground however deep they are: nothing covers them.
RoadBed::Point bed_of(const Sample& sample, Terrain terrain) {
  const glm::vec2 place(sample.position);
  const bool lies_on_terrain =
      !std::isnan(sample.terrain_m) && !(sample.terrain_m < sample.other_m - lies_on_m);
  if (lies_on_terrain) return {{place, sample.terrain_m}, Bed::earth};
  const bool is_trench = terrain == Terrain::generated && !sample.is_covered;
  if (!std::isnan(sample.other_m) && (is_trench || !std::isnan(sample.terrain_m)))
    return {{place, sample.other_m - below_cover_m}, Bed::cut};
  return {sample.position, Bed::none};
}

}  // namespace

std::optional<Terrain> terrain_of(const std::string& object) {
  if (object == "TINRelief") return Terrain::surveyed;
  if (object.starts_with("TINRelief ")) return Terrain::generated;
  return std::nullopt;
}

float half_bed_m(const Road& road) { return half_width_m(road) + paved_beside_m + shoulder_m; }

std::vector<Road> right_turns(const RoadGraph& graph) {
  std::vector<Road> turns;
  for (const Lane& lane : graph.lanes) {
    if (lane.crossing < 0) continue;
    const MeasuredPath path(lane.points);
    if (cross_in_plan(path.direction_at(0.0f), path.direction_at(path.length())) > -min_turn_sine) continue;
    Road& turn = turns.emplace_back();
    turn.is_one_way = true, turn.lane_width_m = lane.width_m;
    const int steps = std::max(2, int(std::ceil(path.length() / turn_step_m)));
    for (int i = 0; i <= steps; ++i) turn.path.push_back(path.at(path.length() * float(i) / float(steps)));
  }
  return turns;
}

bool has_ground(const Scene& scene, const Object& object) {
  return !object.is_dynamic && object.is_visible && !surrounds_place(scene, object);
}

std::vector<RoadBed> road_beds(const Scene& scene, std::span<const Road> roads, Terrain terrain) {
  struct OfRoad {
    std::size_t first, end, first_edge;  // of its samples
  };
  std::vector<Sample> samples;
  std::vector<OfRoad> of_roads;
  of_roads.reserve(roads.size());
  for (const Road& road : roads) {
    const std::size_t first = samples.size();
    add_samples(road.path, samples);
    const std::size_t end = samples.size();
    of_roads.push_back({first, end, add_edges(first, half_bed_m(road), samples)});
  }

  Samples by_cell(samples);
  for (const Object& object : scene.objects) {
    if (!has_ground(scene, object)) continue;
    const std::vector<glm::mat4> pose = object.pose.empty() ? rest_pose(*object.model) : object.pose;
    for (const Part& part : object.model->parts) {
      const GroundKind ground = ground_of(part.object, terrain);
      if (ground == GroundKind::none) continue;
      const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
      const auto corner = [&](std::size_t i) {
        return glm::vec3(world_from_mesh * glm::vec4(part.mesh.positions[part.mesh.indices[i]], 1.0f));
      };
      for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3)
        by_cell.note(corner(i), corner(i + 1), corner(i + 2), ground);
    }
  }

  std::vector<RoadBed> beds;
  beds.reserve(roads.size());
  for (std::size_t i = 0; i < roads.size(); ++i) {
    RoadBed& bed = beds.emplace_back();
    bed.half_m = half_bed_m(roads[i]);
    const auto& [first, end, first_edge] = of_roads[i];
    for (std::size_t k = first; k < end; ++k) bed.points.push_back(bed_of(samples[k], terrain));
    // Generated ground was made for the ground above it, and follows it from below: where it lies deep across
    // the whole bed nothing is cut, but between such a place and one that is cut it may rise.
    const std::vector<RoadBed::Point> alone = bed.points;
    const auto is_deep = [&](std::size_t k) {
      const std::size_t edge = first_edge + 2 * k;
      return terrain == Terrain::generated && is_below_cover(samples[first + k]) &&
             is_below_cover(samples[edge]) && is_below_cover(samples[edge + 1]);
    };
    const auto stays_cut = [&](std::size_t k) {
      return k < alone.size() && alone[k].kind == Bed::cut && !is_deep(k);
    };
    for (std::size_t k = 0; k < alone.size(); ++k)
      if (is_deep(k) && !stays_cut(k - 1) && !stays_cut(k + 1)) bed.points[k].kind = Bed::none;
  }
  return beds;
}

}  // namespace parvis::scene
