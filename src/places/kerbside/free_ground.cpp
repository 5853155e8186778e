#include "places/kerbside/free_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bounds.h"
#include "base/cut_polygon.h"
#include "life/vegetation/scene_plant.h"
#include "places/kerbside/cells_under.h"
#include "scene/data/model_parts.h"

namespace parvis::kerbside {
namespace {

using glm::vec2, glm::vec3;

constexpr unsigned char lane_bit = 1, thing_bit = 2, deck_bit = 4;
constexpr float lane_reach_m = 12.0f;  // beside a lane, of what is looked at
constexpr float free_cell_m = 0.4f;
constexpr float low_m = 0.35f, high_m = 3.5f;
constexpr float min_trunk_m = 0.15f;
constexpr float ground_from_lane_m = 2.5f;  // up and down, at most: what GroundHeights knows
constexpr float steep = 0.8f;               // z of unit normals below which a triangle is a side of something

Bounds bounds_of(const scene::RoadGraph& roads) {
  Bounds bounds;
  for (const scene::Lane& lane : roads.lanes)
    for (const vec3& point : lane.points) bounds.add(point);
  return bounds;
}

scene::GroundGrid grid_of(const scene::RoadGraph& roads, const Bounds& area) {
  const Bounds lanes = bounds_of(roads);
  const vec2 origin = glm::max(vec2(lanes.min) - lane_reach_m, vec2(area.min)),
             end = glm::min(vec2(lanes.max) + lane_reach_m, vec2(area.max));
  if (lanes.empty() || !glm::all(glm::lessThan(origin, end))) return {};
  const glm::ivec2 cells(glm::ceil((end - origin) / free_cell_m));
  return {cells.x, cells.y, free_cell_m, origin};
}

}  // namespace

Bounds FreeGround::everywhere() {
  constexpr float endless = std::numeric_limits<float>::infinity();
  Bounds bounds;
  bounds.min = vec3(-endless), bounds.max = vec3(endless);
  return bounds;
}

std::uint64_t FreeGround::bytes(const scene::RoadGraph& roads, const Bounds& area) {
  const scene::GroundGrid grid = grid_of(roads, area);
  return std::uint64_t(grid.width) * std::uint64_t(grid.height);
}

FreeGround::FreeGround(const scene::Scene& scene, const Bounds& area)
    : heights_(scene, lane_reach_m), taken_(grid_of(scene.roads, area), 0) {
  const Bounds lanes = bounds_of(scene.roads);
  lowest_m_ = lanes.min.z - ground_from_lane_m + low_m;
  highest_m_ = lanes.max.z + ground_from_lane_m + high_m;
  take_lanes(scene.roads);
  take_things(scene);
  take_plants(scene);
}

void FreeGround::mark(vec2 point, float radius_m, unsigned char with) {
  const vec2 size(taken_.width, taken_.height), middle = (point - taken_.origin) / taken_.cell_m;
  const float radius = radius_m / taken_.cell_m;
  if (!(glm::all(glm::greaterThanEqual(middle + radius, vec2(0.0f))) &&
        glm::all(glm::lessThan(middle - radius, size))))
    return;  // off the plan, or numbers that are not finite
  const glm::ivec2 first(glm::max(glm::floor(middle - radius), vec2(0.0f))),
      last(glm::min(glm::floor(middle + radius), size - 1.0f));
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x)
      if (vec2(x, y) == glm::floor(middle) || glm::distance(taken_.centre_of({x, y}), point) < radius_m)
        taken_.at(x, y) |= with;
}

void FreeGround::take(vec2 point, float radius_m) { mark(point, radius_m, thing_bit); }

bool FreeGround::is_free(vec2 point, float radius_m, float from_lanes_m, float from_decks_m) const {
  const float reach = std::max({radius_m, from_lanes_m, from_decks_m});
  const glm::ivec2 first = taken_.cell_at(point - reach), last = taken_.cell_at(point + reach),
                   own = taken_.cell_at(point);
  if (!taken_.contains(first.x, first.y) || !taken_.contains(last.x, last.y)) return false;
  for (int y = first.y; y <= last.y; ++y)
    for (int x = first.x; x <= last.x; ++x) {
      const unsigned char taken = taken_.at(x, y);
      if (taken == 0) continue;
      // A carriageway is known to half a cell, by the middles of cells; a thing is anywhere in its cell.
      const vec2 middle = taken_.centre_of({x, y}), half(0.5f * taken_.cell_m);
      const bool is_own = glm::ivec2(x, y) == own;
      if ((taken & lane_bit) != 0 && from_lanes_m > 0.0f &&
          (is_own || glm::distance(middle, point) < from_lanes_m))
        return false;
      const float away_m = glm::distance(glm::clamp(point, middle - half, middle + half), point);
      if ((taken & thing_bit) != 0 && away_m < radius_m) return false;
      if ((taken & deck_bit) != 0 && away_m < from_decks_m) return false;
    }
  return true;
}

void FreeGround::take_lanes(const scene::RoadGraph& roads) {
  for (const scene::Lane& lane : roads.lanes)
    for (std::size_t i = 0; i + 1 < lane.points.size(); ++i) {
      const vec2 from(lane.points[i]), to(lane.points[i + 1]);
      const int steps = std::max(1, int(std::ceil(glm::distance(from, to) / taken_.cell_m)));
      for (int s = 0; s <= steps; ++s)
        mark(glm::mix(from, to, float(s) / float(steps)), 0.5f * lane.width_m, lane_bit);
    }
}

void FreeGround::take_things(const scene::Scene& scene) {
  for (const scene::Object& object : scene.objects) {
    if (!object.is_visible) continue;
    const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
    for (const scene::Part& part : object.model->parts) {
      const glm::mat4 world = object.world_from_model * pose[std::size_t(part.node)];
      const auto corner = [&](std::size_t i) {
        return vec3(world * glm::vec4(part.mesh.positions[part.mesh.indices[i]], 1.0f));
      };
      const bool is_in_tunnel = part.object == "Road tunnel";  // as readers of maps call its floor
      const bool is_of_bridge = part.object.starts_with("Bridge");
      for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
        is_in_tunnel ? take_floor(corner(i), corner(i + 1), corner(i + 2))
                     : take_triangle(corner(i), corner(i + 1), corner(i + 2));
        if (is_of_bridge) take_deck(corner(i), corner(i + 1), corner(i + 2));
      }
    }
  }
}

/// Trunks of trees, and hedges and grass along their whole length. Crowns hang higher than what stands.
void FreeGround::take_plants(const scene::Scene& scene) {
  for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene)) {
    if (!plant.is_visible) continue;
    const vegetation::PlantKind& kind = plant.shape->kind();
    const float scale = glm::length(vec3(plant.world_from_plant[0]));
    if (kind.habit == vegetation::Habit::tree) {
      take(vec2(plant.world_from_plant[3]),
           scale * std::max(min_trunk_m, kind.trunk_share * plant.shape->recipe.height_m));
      continue;
    }
    const Bounds& bounds = plant.shape->bounds;
    if (kind.habit == vegetation::Habit::sward && bounds.max.z * scale < low_m) continue;  // lawns are ground
    Corners outline;
    for (const vec2 corner : {vec2(0, 0), vec2(1, 0), vec2(1, 1), vec2(0, 1)})
      outline.emplace_back(plant.world_from_plant *
                           glm::vec4(vec2(bounds.min) + corner * vec2(bounds.size()), 0.0f, 1.0f));
    each_cell_under(taken_, std::move(outline),
                    [&](glm::ivec2 cell, const Corners&) { taken_.at(cell.x, cell.y) |= thing_bit; });
  }
}

/// Nothing stands in a tunnel. Where the nearest lane is a street above it, the ground is that street's.
void FreeGround::take_floor(vec3 a, vec3 b, vec3 c) {
  each_cell_under(taken_, Corners{a, b, c}, [&](glm::ivec2 cell, const Corners& part) {
    const float ground_m = heights_.at(taken_.centre_of(cell), float(part.front().z));
    if (std::abs(ground_m - float(part.front().z)) < low_m) taken_.at(cell.x, cell.y) |= thing_bit;
  });
}

/// Takes the plan of a deck: nothing parks or grows on a bridge, nor through it from below.
void FreeGround::take_deck(vec3 a, vec3 b, vec3 c) {
  const vec3 across = glm::cross(b - a, c - a);
  if (!(std::abs(across.z) > steep * glm::length(across))) return;
  each_cell_under(taken_, Corners{a, b, c},
                  [&](glm::ivec2 cell, const Corners&) { taken_.at(cell.x, cell.y) |= deck_bit; });
}

/// Takes a triangle, which is ground if it is level, or a roof above things that stand.
void FreeGround::take_triangle(vec3 a, vec3 b, vec3 c) {
  const vec2 low = glm::min(vec2(a), glm::min(vec2(b), vec2(c))),
             high = glm::max(vec2(a), glm::max(vec2(b), vec2(c)));
  const vec2 end = taken_.origin + taken_.cell_m * vec2(taken_.width, taken_.height);
  if (glm::any(glm::lessThan(high, taken_.origin)) || glm::any(glm::greaterThan(low, end))) return;
  const vec3 across = glm::cross(b - a, c - a);
  const float area = glm::length(across);
  if (!(area > 0.0f) || std::abs(across.z) > steep * area) return;
  // What slants far may have all cells under it: most are not near the ground.
  Corners standing = cut(Corners{a, b, c}, [&](const glm::dvec3& p) { return p.z - double(lowest_m_); });
  standing = cut(standing, [&](const glm::dvec3& p) { return double(highest_m_) - p.z; });
  if (standing.empty()) return;
  each_cell_under(taken_, std::move(standing), [&](glm::ivec2 cell, const Corners& part) {
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    const auto [lowest, highest] = std::ranges::minmax_element(part, {}, &glm::dvec3::z);
    const auto above_ground_m = [&](const glm::dvec3& p) {
      return float(p.z) - heights_.at(vec2(p), unknown);
    };
    if (above_ground_m(*highest) > low_m && above_ground_m(*lowest) < high_m)
      taken_.at(cell.x, cell.y) |= thing_bit;
  });
}

}  // namespace parvis::kerbside
