#include "land/heights/ground_heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/bounds.h"
#include "land/heights/city_surfaces.h"
#include "scene/data/path.h"

namespace parvis::scene {

namespace {

constexpr float finest_ground_cell_m = 0.5f;
constexpr float max_ground_cells = 16e6f;
constexpr float largest_thing_m2 = 40.0f;  // that is no ground: cars, benches, crowns, kiosks
constexpr float steepest = 0.25f;          // of ground: what rises faster is the edge of a thing
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

/// Whether light stops at the material: leaves and panes are no ground.
bool is_solid(const Material& material) {
  return material.alpha_mode == Alpha::opaque && material.translucency == 0.0f && !material.refracts();
}

constexpr std::array<glm::ivec2, 4> neighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// The cells around `start` that it reaches without a step; they are marked as seen.
std::vector<glm::ivec2> region_around(const HeightRaster& heights, glm::ivec2 start, Mask& is_seen) {
  const float step_m = steepest * heights.cell_m;
  std::vector<glm::ivec2> region{start};
  is_seen.at(start.x, start.y) = 1;
  for (std::size_t i = 0; i < region.size(); ++i)
    for (const glm::ivec2 aside : neighbours) {
      const glm::ivec2 cell = region[i] + aside;
      if (!heights.contains(cell.x, cell.y) || is_seen.at(cell.x, cell.y)) continue;
      if (!(std::abs(heights.at(cell.x, cell.y) - heights.at(region[i].x, region[i].y)) <= step_m)) continue;
      is_seen.at(cell.x, cell.y) = 1;
      region.push_back(cell);
    }
  return region;
}

/// Gives the cells that things were taken from the mean of their neighbours, from their edges inward.
void fill_taken(HeightRaster& heights, std::vector<glm::ivec2> taken) {
  while (!taken.empty()) {
    std::vector<std::pair<glm::ivec2, float>> known;
    std::vector<glm::ivec2> left;
    for (const glm::ivec2 cell : taken) {
      float sum = 0.0f;
      int count = 0;
      for (const glm::ivec2 aside : neighbours)
        if (const glm::ivec2 next = cell + aside;
            heights.contains(next.x, next.y) && !std::isnan(heights.at(next.x, next.y)))
          sum += heights.at(next.x, next.y), ++count;
      if (count > 0)
        known.emplace_back(cell, sum / float(count));
      else
        left.push_back(cell);
    }
    if (known.empty()) return;
    for (const auto& [cell, height] : known) heights.at(cell.x, cell.y) = height;
    taken = std::move(left);
  }
}

}  // namespace

GroundHeights::GroundHeights(const Scene& scene, float reach_m) {
  note_lanes(scene.roads, reach_m);
  heights_m_ = GroundRaster<float>(lane_heights_m_, unknown);
  HeightRaster unnamed_m(lane_heights_m_, unknown);
  for (const Object& object : scene.objects)
    if (!object.is_dynamic && object.is_visible) note_object(object, unnamed_m);
  add_without_things(std::move(unnamed_m));
}

void GroundHeights::note_lanes(const RoadGraph& roads, float reach_m) {
  Bounds bounds;
  for (const Lane& lane : roads.lanes)
    for (const glm::vec3& p : lane.points) bounds.add(p);
  const glm::vec2 size = glm::vec2(bounds.size()) + 2.0f * reach_m;
  const float cell_m = std::max(finest_ground_cell_m, std::sqrt(size.x * size.y / max_ground_cells));
  const glm::ivec2 cells = glm::ivec2(glm::ceil(size / cell_m)) + 1;
  lane_heights_m_ = GroundRaster<float>(cells.x, cells.y, cell_m, glm::vec2(bounds.min) - reach_m, unknown);

  GroundRaster<float> distances(lane_heights_m_, reach_m);
  for (const Lane& lane : roads.lanes) {
    const MeasuredPath path(lane.points);
    const int steps = int(std::ceil(path.length()));  // of a metre at most
    for (int step = 0; step <= steps; ++step) {
      const glm::vec3 p = path.at(std::min(float(step), path.length()));
      const glm::ivec2 low = glm::max(distances.cell_at(glm::vec2(p) - reach_m), glm::ivec2(0));
      const glm::ivec2 high = glm::min(distances.cell_at(glm::vec2(p) + reach_m), cells - 1);
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
          const float distance = glm::distance(distances.centre_of({x, y}), glm::vec2(p));
          if (distance < distances.at(x, y)) distances.at(x, y) = distance, lane_heights_m_.at(x, y) = p.z;
        }
    }
  }
}

void GroundHeights::note_object(const Object& object, HeightRaster& unnamed_m) {
  const Model& model = *object.model;
  const bool names_ground =
      std::ranges::any_of(model.parts, [](const Part& part) { return is_city_surface(part.object); });
  const std::vector<glm::mat4> pose = object.pose.empty() ? rest_pose(model) : object.pose;
  for (const Part& part : model.parts) {
    const bool may_be_ground = names_ground ? is_ground(part.object) || part.object.starts_with("Bridge")
                                            : is_solid(model.materials[std::size_t(part.material)]);
    if (!may_be_ground) continue;
    const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
    const auto corner = [&](std::size_t i) {
      return glm::vec3(world_from_mesh * glm::vec4(part.mesh.positions[part.mesh.indices[i]], 1.0f));
    };
    const float reach_m = part.object.starts_with("Bridge") ? deck_reach_m : ground_reach_m;
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3)
      note_triangle(names_ground ? heights_m_ : unnamed_m, corner(i), corner(i + 1), corner(i + 2), reach_m);
  }
}

void GroundHeights::note_triangle(HeightRaster& heights_m, glm::vec3 a, glm::vec3 b, glm::vec3 c,
                                  float reach_m) {
  each_height(heights_m, a, b, c, [&](glm::ivec2 cell, float height_m) {
    const float lane_m = lane_heights_m_.at(cell.x, cell.y);
    float& known_m = heights_m.at(cell.x, cell.y);
    if (std::abs(height_m - lane_m) < reach_m && !(known_m >= height_m)) known_m = height_m;
  });
}

/// Adds the heights of models that do not name their ground, without small regions that steps bound. Below
/// these the ground is the named one, else what lies around them.
void GroundHeights::add_without_things(HeightRaster unnamed_m) {
  if (std::ranges::all_of(unnamed_m.cells, [](float height) { return std::isnan(height); })) return;
  const HeightRaster named_m = heights_m_;
  for (std::size_t i = 0; i < named_m.cells.size(); ++i)
    if (!(named_m.cells[i] >= unnamed_m.cells[i]) && !std::isnan(unnamed_m.cells[i]))
      heights_m_.cells[i] = unnamed_m.cells[i];
  Mask is_seen(heights_m_, 0);
  std::vector<glm::ivec2> taken;
  const float cell_m2 = heights_m_.cell_m * heights_m_.cell_m;
  for (int y = 0; y < heights_m_.height; ++y)
    for (int x = 0; x < heights_m_.width; ++x) {
      if (is_seen.at(x, y) || std::isnan(heights_m_.at(x, y))) continue;
      const std::vector<glm::ivec2> region = region_around(heights_m_, {x, y}, is_seen);
      if (float(region.size()) * cell_m2 < largest_thing_m2)
        taken.insert(taken.end(), region.begin(), region.end());
    }
  for (const glm::ivec2 cell : taken) heights_m_.at(cell.x, cell.y) = named_m.at(cell.x, cell.y);
  std::erase_if(taken, [&](glm::ivec2 cell) { return !std::isnan(heights_m_.at(cell.x, cell.y)); });
  fill_taken(heights_m_, std::move(taken));
}

float GroundHeights::at(glm::vec2 point, float fallback) const {
  return height_at(heights_m_, point).value_or(fallback);
}

float GroundHeights::beside_lane(glm::vec2 point, float lane_m) const {
  const glm::vec2 place = (point - heights_m_.origin) / heights_m_.cell_m - 0.5f;
  const glm::ivec2 first(glm::floor(place));
  const glm::vec2 fraction = place - glm::floor(place);
  float sum = 0.0f, weights = 0.0f;
  for (int k = 0; k < 4; ++k) {
    const glm::ivec2 cell = first + glm::ivec2(k % 2, k / 2);
    if (!heights_m_.contains(cell.x, cell.y)) continue;
    const float height_m = heights_m_.at(cell.x, cell.y);
    if (!(std::abs(height_m - lane_m) < ground_reach_m)) continue;  // unknown, or of another lane
    const float weight = (k % 2 ? fraction.x : 1.0f - fraction.x) * (k / 2 ? fraction.y : 1.0f - fraction.y);
    sum += weight * height_m, weights += weight;
  }
  return weights > 1e-3f ? sum / weights : lane_m;
}

}  // namespace parvis::scene
