#include "formats/city_models/osm_earthworks.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <set>
#include <tuple>
#include <utility>

#include "land/heights/city_surfaces.h"
#include "land/heights/ground_heights.h"
#include "land/roads/road_beds.h"
#include "land/roads/road_builder.h"
#include "land/roads/shaped_terrain.h"

namespace parvis::scene {
namespace {

constexpr double raised_m = 0.05;  // of ramps, over the ground
// The same of turns, which have the heights of the roads' middle lines beside them.
constexpr double turn_raised_m = ground_reach_m;
constexpr float ramp_step_m = 10.0f;     // between points of beds about ramps
constexpr float near_ramp_m = 40.0f;     // from ramps: what lies farther keeps its ground
constexpr float largest_side_m = 40.0f;  // of triangles that are divided where works bend them
constexpr float level_range_m = 0.1f;    // of heights of a part that lies level
constexpr int max_depth_of_sides = 40;

/// Cells of the plan with something raised in them, or beside one that has.
class RampCells {
 public:
  void add(glm::vec2 point) { raised_.insert(cell_of(point)); }
  bool are_near(glm::vec2 point) const {
    const auto [column, row] = cell_of(point);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (raised_.contains({column + dx, row + dy})) return true;
    return false;
  }
  bool empty() const { return raised_.empty(); }

 private:
  static std::pair<int, int> cell_of(glm::vec2 p) {
    return {int(std::floor(p.x / near_ramp_m)), int(std::floor(p.y / near_ramp_m))};
  }
  std::set<std::pair<int, int>> raised_;
};

std::vector<glm::vec3> in_steps(const std::vector<glm::vec3>& path) {
  std::vector<glm::vec3> points;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const glm::vec3 next = path[std::min(i + 1, path.size() - 1)];
    const int steps = std::max(1, int(std::ceil(glm::distance(path[i], next) / ramp_step_m)));
    for (int k = 0; k < (i + 1 < path.size() ? steps : 1); ++k)
      points.push_back(glm::mix(path[i], next, float(k) / float(steps)));
  }
  return points;
}

/// The parts of a road near ramps, each as a bed.
void add_beds_near(const RampCells& ramps, const std::vector<glm::vec3>& points, float half_m, bool is_bridge,
                   bool is_turn, std::vector<RoadBed>& beds) {
  bool is_bed_open = false;
  for (const glm::vec3& point : points) {
    const bool is_near = ramps.are_near(glm::vec2(point));
    if (is_near && !is_bed_open) beds.push_back({{}, half_m, is_turn});
    is_bed_open = is_near;
    if (is_near)
      beds.back().points.push_back(
          {point, is_bridge || double(point.z) < -raised_m ? Bed::none : Bed::earth});
  }
}

/// A mesh whose triangles have no long sides where works may bend them.
Mesh with_short_sides(const Mesh& mesh, const Earthworks& works) {
  Mesh result = mesh;
  result.indices.clear();
  const auto plan = [&](std::uint32_t i) { return glm::vec2(result.positions[i]); };
  const auto divide = [&](auto&& self, std::array<std::uint32_t, 3> t, int depth) -> void {
    const glm::vec2 low = glm::min(plan(t[0]), glm::min(plan(t[1]), plan(t[2]))),
                    high = glm::max(plan(t[0]), glm::max(plan(t[1]), plan(t[2])));
    std::size_t longest = 0;
    float longest_m = 0.0f;
    for (std::size_t k = 0; k < 3; ++k)
      if (const float side_m = glm::distance(plan(t[k]), plan(t[(k + 1) % 3])); side_m > longest_m)
        longest = k, longest_m = side_m;
    if (!(longest_m > largest_side_m) || depth == max_depth_of_sides || !works.may_change(low, high)) {
      result.indices.insert(result.indices.end(), t.begin(), t.end());
      return;
    }
    const std::uint32_t from = t[longest], to = t[(longest + 1) % 3], other = t[(longest + 2) % 3];
    const auto middle = std::uint32_t(result.positions.size());
    const auto halve = [&](auto& values) {
      if (values.size() == middle) values.push_back(0.5f * (values[from] + values[to]));
    };
    halve(result.normals), halve(result.uvs), halve(result.second_uvs), halve(result.colours);
    halve(result.positions);
    self(self, {from, middle, other}, depth + 1);
    self(self, {middle, to, other}, depth + 1);
  };
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    divide(divide, {mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]}, 0);
  return result;
}

}  // namespace

GroundOnMap ground_shaped_for(const std::vector<Road>& roads, const GroundOnMap& ground,
                              const glm::dvec3& origin) {
  if (!ground) return {};
  // Of roads that make no lanes the script's `streets` complains: here they have their beds, and no turns.
  const Result<RoadGraph> graph = build_road_graph(roads);
  const std::vector<Road> turns = graph ? right_turns(*graph) : std::vector<Road>();
  std::vector<RoadBed> beds;
  beds.reserve(roads.size() + turns.size());
  const auto add_bed = [&](const Road& road, bool is_turn) {
    RoadBed& bed = beds.emplace_back();
    bed.half_m = half_bed_m(road), bed.is_turn = is_turn;
    bed.points.reserve(road.path.size());
    for (const glm::vec3& point : road.path) {
      const bool is_raised = double(point.z) > ground(glm::dvec2(point) + glm::dvec2(origin)) +
                                                   (is_turn ? turn_raised_m : raised_m);
      bed.points.push_back({point, is_raised ? Bed::cut : Bed::earth});
    }
  };
  for (const Road& road : roads) add_bed(road, false);
  for (const Road& turn : turns) add_bed(turn, true);
  return [works = std::make_shared<const Earthworks>(beds), ground, origin](glm::dvec2 on_map) {
    const double bare_m = ground(on_map);
    const glm::vec2 place(on_map - glm::dvec2(origin));
    return bare_m + double(works->at(place, float(bare_m)) - float(bare_m));
  };
}

std::shared_ptr<const Earthworks> works_for_ramps(const std::vector<Road>& roads,
                                                  const std::function<bool(const Road&)>& is_bridge) {
  RampCells ramps;
  for (const Road& road : roads)
    if (!is_bridge(road))
      for (const glm::vec3& point : in_steps(road.path))
        if (double(point.z) > raised_m) ramps.add(glm::vec2(point));
  if (ramps.empty()) return nullptr;
  std::vector<Road> near;
  for (const Road& road : roads)
    if (std::ranges::any_of(in_steps(road.path), [&](glm::vec3 p) { return ramps.are_near(glm::vec2(p)); }))
      near.push_back(road);
  std::vector<RoadBed> beds;
  for (const Road& road : near)
    add_beds_near(ramps, in_steps(road.path), half_bed_m(road), is_bridge(road), false, beds);
  if (const Result<RoadGraph> graph = build_road_graph(near))
    for (const Road& turn : right_turns(*graph))
      add_beds_near(ramps, in_steps(turn.path), half_bed_m(turn), false, true, beds);
  return std::make_shared<const Earthworks>(beds);
}

void raise_ground(Model& model, const Earthworks& works) {
  for (Part& part : model.parts) {
    if (!is_ground(part.object) || part.mesh.indices.empty()) continue;
    const Bounds bounds = part.mesh.bounds();
    if (bounds.size().z > level_range_m) continue;
    // At its own height above the ground, so that what lies on the other ground does so on a bank, too.
    const glm::mat4 on_ground = glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, -bounds.min.z});
    part.mesh = shaped(with_short_sides(part.mesh, works), on_ground, works);
  }
}

}  // namespace parvis::scene
