#include "formats/terrain/ground_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/bounds.h"
#include "scene/data/path.h"

namespace parvis::scene {

namespace {

constexpr float finest_cell_m = 0.5f;
constexpr float max_cells = 16e6f;
constexpr float above_or_below_m = 2.5f;  // of a lane: beyond are roofs, bridges, cellars
constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

}  // namespace

GroundHeights::GroundHeights(const Scene& scene, float reach_m) {
  note_lanes(scene.roads, reach_m);
  heights_m_ = GroundRaster<float>(lane_heights_m_, unknown);
  for (const Object& object : scene.objects)
    if (!object.is_dynamic) note_object(object);
}

void GroundHeights::note_lanes(const RoadGraph& roads, float reach_m) {
  Bounds bounds;
  for (const Lane& lane : roads.lanes)
    for (const glm::vec3& p : lane.points) bounds.add(p);
  const glm::vec2 size = glm::vec2(bounds.size()) + 2.0f * reach_m;
  const float cell_m = std::max(finest_cell_m, std::sqrt(size.x * size.y / max_cells));
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

void GroundHeights::note_object(const Object& object) {
  const std::vector<glm::mat4> pose = object.pose.empty() ? rest_pose(*object.model) : object.pose;
  for (const Part& part : object.model->parts) {
    const glm::mat4 world_from_mesh = object.world_from_model * pose[std::size_t(part.node)];
    const auto corner = [&](std::size_t i) {
      return glm::vec3(world_from_mesh * glm::vec4(part.mesh.positions[part.mesh.indices[i]], 1.0f));
    };
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3)
      note_triangle(corner(i), corner(i + 1), corner(i + 2));
  }
}

void GroundHeights::note_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
  each_height(heights_m_, a, b, c, [this](glm::ivec2 cell, float height_m) {
    const float lane_m = lane_heights_m_.at(cell.x, cell.y);
    float& known_m = heights_m_.at(cell.x, cell.y);
    if (std::abs(height_m - lane_m) < above_or_below_m && !(known_m >= height_m)) known_m = height_m;
  });
}

float GroundHeights::at(glm::vec2 point, float fallback) const {
  return height_at(heights_m_, point).value_or(fallback);
}

}  // namespace parvis::scene
