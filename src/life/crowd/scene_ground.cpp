#include "life/crowd/scene_ground.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/bounds.h"
#include "capture/trees/scene_tree.h"
#include "land/roads/street_crossings.h"
#include "life/vegetation/scene_plant.h"
#include "scene/data/model.h"
#include "scene/data/model_parts.h"
#include "scene/data/surroundings.h"

namespace parvis::crowd {
namespace {

constexpr float to_kerb_m =
    3.2f;  // from a street's outer lane: a parking strip, and a body's width of pavement
constexpr float max_strip_m = 4.0f;  // of a lane whose points lie farther apart: heights change in between

/// The kind of ground by its material: parking strips, say, are carriageways without a lane.
GroundKind kind_of(std::string_view material) {
  constexpr std::array<std::string_view, 4> roads{"road_", "zebra", "carriageway", "asphalt"};
  return std::ranges::any_of(roads, [&](std::string_view road) { return material.starts_with(road); })
             ? GroundKind::road
             : GroundKind::floor;
}

void add_triangles(const scene::Object& object, glm::vec2 centre, float radius_m, WalkingGround& ground) {
  const std::vector<glm::mat4> pose = object.pose.empty() ? scene::rest_pose(*object.model) : object.pose;
  for (std::size_t p = 0; p < object.model->parts.size(); ++p) {
    const scene::Part& part = object.model->parts[p];
    const Mesh& mesh = object.mesh(p);
    const GroundKind kind = part.material >= 0
                                ? kind_of(object.model->materials[std::size_t(part.material)].name)
                                : GroundKind::floor;
    const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      std::array<glm::vec3, 3> corners;
      glm::vec2 low(1e9f), high(-1e9f);
      for (std::size_t c = 0; c < 3; ++c) {
        corners[c] = glm::vec3(world_from_mesh * glm::vec4(mesh.positions[mesh.indices[i + c]], 1.0f));
        low = glm::min(low, glm::vec2(corners[c])), high = glm::max(high, glm::vec2(corners[c]));
      }
      const glm::vec2 nearest = glm::clamp(centre, low, high);
      if (!(glm::distance(nearest, centre) < radius_m)) continue;
      ground.corners.insert(ground.corners.end(), corners.begin(), corners.end());
      ground.kinds.push_back(kind);
    }
  }
}

void add_lane(const scene::Lane& lane, glm::vec2 centre, float radius_m, WalkingGround& ground) {
  for (std::size_t i = 0; i + 1 < lane.points.size(); ++i) {
    const glm::vec3 a = lane.points[i], b = lane.points[i + 1];
    const int pieces = std::max(1, int(std::ceil(glm::distance(a, b) / max_strip_m)));
    for (int k = 0; k < pieces; ++k) {
      const RoadStrip strip{glm::mix(a, b, float(k) / float(pieces)),
                            glm::mix(a, b, float(k + 1) / float(pieces)), lane.width_m};
      if (glm::distance(glm::vec2(strip.a), centre) < radius_m) ground.roads.push_back(strip);
    }
  }
}

/// The sides and the top of a box that nobody walks through, in a frame of its own.
void add_box(const glm::mat4& world_from_box, glm::vec3 low, glm::vec3 high, glm::vec2 centre, float radius_m,
             WalkingGround& ground) {
  const auto corner = [&](int number) {
    const glm::vec3 p(number & 1 ? high.x : low.x, number & 2 ? high.y : low.y, number & 4 ? high.z : low.z);
    return glm::vec3(world_from_box * glm::vec4(p, 1.0f));
  };
  if (!(glm::distance(glm::vec2(corner(0)), centre) < radius_m)) return;
  constexpr std::array<std::array<int, 4>, 5> faces{
      {{0, 1, 5, 4}, {1, 3, 7, 5}, {3, 2, 6, 7}, {2, 0, 4, 6}, {4, 5, 7, 6}}};
  for (const std::array<int, 4>& face : faces) {
    for (const int k : {0, 1, 2, 0, 2, 3}) ground.corners.push_back(corner(face[std::size_t(k)]));
    ground.kinds.insert(ground.kinds.end(), 2, GroundKind::obstacle);
  }
}

/// Trunks and hedges; grass is walked on.
void add_plants(const scene::Scene& scene, glm::vec2 centre, float radius_m, WalkingGround& ground) {
  constexpr float thinnest_m = 0.12f, trunk_m = 2.0f, captured_trunk_m = 0.2f;  // half of breadths; a height
  for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene)) {
    const vegetation::PlantKind& kind = plant.shape->kind();
    if (!plant.is_visible || kind.habit == vegetation::Habit::sward) continue;
    const float trunk = std::max(thinnest_m, kind.trunk_share * plant.shape->recipe.height_m);
    const Bounds box = kind.habit == vegetation::Habit::hedge
                           ? plant.shape->bounds
                           : Bounds{{-trunk, -trunk, 0.0f}, {trunk, trunk, trunk_m}};
    add_box(plant.world_from_plant, box.min, box.max, centre, radius_m, ground);
  }
  for (const trees::SceneTree& tree : trees::scene_trees(scene)) {
    if (!tree.is_visible) continue;
    const glm::vec3 foot(tree.world_from_tree * glm::vec4(tree.tree->foot, 1.0f));
    add_box(glm::translate(glm::mat4(1.0f), foot), {-captured_trunk_m, -captured_trunk_m, 0.0f},
            {captured_trunk_m, captured_trunk_m, trunk_m}, centre, radius_m, ground);
  }
}

}  // namespace

GroundHeights::GroundHeights(const WalkingGround& ground) : corners_(ground.corners) {
  if (corners_.empty()) return;
  glm::vec2 low(corners_[0]), high = low;
  for (const glm::vec3 p : corners_) low = glm::min(low, glm::vec2(p)), high = glm::max(high, glm::vec2(p));
  constexpr float fine_cell_m = 2.0f, max_cells_per_side = 512.0f;
  corner_ = low;
  cell_m_ = std::max(fine_cell_m, std::max(high.x - low.x, high.y - low.y) / max_cells_per_side);
  size_ = glm::ivec2((high - low) / cell_m_) + 1;
  const auto each_cell = [&](const auto& use) {
    for (std::uint32_t t = 0; 3 * std::size_t(t) < corners_.size(); ++t) {
      const glm::vec3* c = &corners_[3 * std::size_t(t)];
      const glm::vec2 from = glm::min(glm::vec2(c[0]), glm::min(glm::vec2(c[1]), glm::vec2(c[2]))),
                      to = glm::max(glm::vec2(c[0]), glm::max(glm::vec2(c[1]), glm::vec2(c[2])));
      const glm::ivec2 first((from - corner_) / cell_m_), last((to - corner_) / cell_m_);
      for (int y = first.y; y <= last.y; ++y)
        for (int x = first.x; x <= last.x; ++x) use(std::size_t(y * size_.x + x), t);
    }
  };
  starts_.assign(std::size_t(size_.x) * std::size_t(size_.y) + 1, 0);
  each_cell([&](std::size_t cell, std::uint32_t) { ++starts_[cell + 1]; });
  for (std::size_t c = 1; c < starts_.size(); ++c) starts_[c] += starts_[c - 1];
  items_.resize(starts_.back());
  std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
  each_cell([&](std::size_t cell, std::uint32_t t) { items_[next[cell]++] = t; });
}

float GroundHeights::at(glm::vec3 place) const {
  constexpr float above_m = 0.3f, below_m = 0.5f;
  const glm::vec2 p(place), cell = (p - corner_) / cell_m_;
  if (!(cell.x >= 0.0f && cell.y >= 0.0f && cell.x < float(size_.x) && cell.y < float(size_.y)))
    return place.z;
  const auto number = std::size_t(int(cell.y) * size_.x + int(cell.x));
  float height = place.z - below_m;
  for (std::uint32_t i = starts_[number]; i < starts_[number + 1]; ++i) {
    const glm::vec3* c = &corners_[3 * std::size_t(items_[i])];
    const glm::vec2 u = c[1] - c[0], v = c[2] - c[0], w = p - glm::vec2(c[0]);
    const float area = u.x * v.y - u.y * v.x;
    if (area == 0.0f) continue;
    const float s = (w.x * v.y - w.y * v.x) / area, t = (u.x * w.y - u.y * w.x) / area;
    if (s < 0.0f || t < 0.0f || s + t > 1.0f) continue;
    const float z = c[0].z + s * (c[1].z - c[0].z) + t * (c[2].z - c[0].z);
    if (z <= place.z + above_m) height = std::max(height, z);
  }
  return height > place.z - below_m ? height : place.z;
}

WalkingGround ground_of(const scene::Scene& scene, glm::vec2 centre, float radius_m) {
  WalkingGround ground;
  for (const scene::Object& object : scene.objects)
    if (!object.is_dynamic && object.is_visible && object.model && !scene::surrounds_place(scene, object))
      add_triangles(object, centre, radius_m, ground);
  add_plants(scene, centre, radius_m, ground);
  for (const scene::Lane& lane : scene.roads.lanes) add_lane(lane, centre, radius_m, ground);
  for (const scene::StreetCrossing& crossing : scene::street_crossings(scene)) {
    const glm::vec3 across = glm::normalize(crossing.b - crossing.a) * to_kerb_m;
    const RoadStrip strip{crossing.a - across, crossing.b + across, 2.0f * crossing.half_width_m};
    if (glm::distance(glm::vec2(strip.a), centre) < radius_m) ground.crossings.push_back(strip);
  }
  return ground;
}

}  // namespace parvis::crowd
