#include "land/heights/terrain_heights.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "land/heights/city_surfaces.h"

namespace parvis::scene {
namespace {

constexpr float finest_cell_m = 0.5f, max_cells = 4e6f;

/// Calls use(a, b, c) for each triangle of ground, in the model's frame.
template <class Use>
void each_triangle(const Model& terrain, const Use& use) {
  const std::vector<glm::mat4> model_from_node = rest_pose(terrain);
  for (const Part& part : terrain.parts) {
    if (!is_ground(part.object)) continue;
    const glm::mat4& model_from_mesh = model_from_node[std::size_t(part.node)];
    const std::vector<std::uint32_t>& indices = part.mesh.indices;
    const auto corner = [&](std::size_t i) {
      return glm::vec3(model_from_mesh * glm::vec4(part.mesh.positions[indices[i]], 1.0f));
    };
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) use(corner(i), corner(i + 1), corner(i + 2));
  }
}

}  // namespace

TerrainHeights::TerrainHeights(const Model& terrain) : origin_(terrain.origin) {
  Bounds box;
  each_triangle(terrain, [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) { box.add(a), box.add(b), box.add(c); });
  if (!(box.size().x > 0.0f && box.size().y > 0.0f)) return;
  const float cell_m = std::max(finest_cell_m, std::sqrt(box.size().x * box.size().y / max_cells));
  const glm::ivec2 cells = glm::ivec2(glm::ceil(glm::vec2(box.size()) / cell_m)) + 1;
  heights_m_ =
      HeightRaster(cells.x, cells.y, cell_m, glm::vec2(box.min), std::numeric_limits<float>::quiet_NaN());
  each_triangle(terrain, [&](glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    each_height(heights_m_, a, b, c, [&](glm::ivec2 cell, float height_m) {
      float& known_m = heights_m_.at(cell.x, cell.y);
      if (!(known_m >= height_m)) known_m = height_m;
    });
  });
}

std::optional<double> TerrainHeights::at(glm::dvec2 on_map) const {
  const std::optional<float> height_m = height_at(heights_m_, glm::vec2(on_map - glm::dvec2(origin_)));
  if (!height_m) return std::nullopt;
  return origin_.z + double(*height_m);
}

std::optional<double> TerrainHeights::lowest() const {
  std::optional<float> min_m;
  for (const float height_m : heights_m_.cells)
    if (!std::isnan(height_m)) min_m = std::min(min_m.value_or(height_m), height_m);
  if (!min_m) return std::nullopt;
  return origin_.z + double(*min_m);
}

}  // namespace parvis::scene
