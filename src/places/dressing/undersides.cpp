#include "places/dressing/undersides.h"

#include <algorithm>
#include <cmath>

#include "base/plan_polygon.h"

namespace parvis::dressing {
namespace {

constexpr const char* underside_name = "OuterCeilingSurface";
constexpr float underside_cell_m = 8.0f;
constexpr long max_underside_cells = 10'000;  // no underside is so large
constexpr float behind_m = 0.1f;              // of the wall: where its house is
constexpr float same_underside_m = 0.1f;
constexpr int max_looked_at = 500;  // in one cell: maps that heap more on a place are wrong

glm::ivec2 cell_of(glm::vec2 point) { return glm::ivec2(glm::floor(point / underside_cell_m)); }

std::uint64_t key(int x, int y) { return std::uint64_t(std::uint32_t(x)) << 32u | std::uint32_t(y); }

}  // namespace

Undersides::Undersides(const scene::Model& model) {
  const std::vector<glm::mat4> pose = scene::rest_pose(model);
  for (const scene::Part& part : model.parts) {
    if (model.materials[std::size_t(part.material)].name != underside_name) continue;
    const glm::mat4& model_from_node = pose[std::size_t(part.node)];
    for (std::size_t i = 0; i + 2 < part.mesh.indices.size(); i += 3) {
      Triangle triangle;
      for (std::size_t k = 0; k < 3; ++k)
        triangle[k] =
            glm::vec3(model_from_node * glm::vec4(part.mesh.positions[part.mesh.indices[i + k]], 1.0f));
      add(triangle);
    }
  }
}

void Undersides::add(const Triangle& triangle) {
  const glm::vec2 a(triangle[0]), b(triangle[1]), c(triangle[2]);
  const glm::ivec2 low = cell_of(glm::min(a, glm::min(b, c))), high = cell_of(glm::max(a, glm::max(b, c)));
  if (long(high.x - low.x + 1) * long(high.y - low.y + 1) > max_underside_cells) return;
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) cells_[key(x, y)].push_back(std::uint32_t(triangles_.size()));
  triangles_.push_back(triangle);
}

bool Undersides::begin_at(const WallPanel& panel) const {
  const float middle = 0.5f * (panel.low.x + panel.high.x), foot_m = panel.low.y;
  const glm::vec2 at =
      glm::vec2(panel.along) * middle + glm::vec2(panel.normal) * (panel.offset_m - behind_m);
  const glm::ivec2 cell = cell_of(at);
  const auto here = cells_.find(key(cell.x, cell.y));
  if (here == cells_.end()) return false;
  int left = max_looked_at;
  for (const std::uint32_t index : here->second) {
    if (--left < 0) return false;
    const Triangle& triangle = triangles_[index];
    const bool is_at_foot = std::ranges::all_of(
        triangle, [&](const glm::vec3& corner) { return std::abs(corner.z - foot_m) < same_underside_m; });
    if (is_at_foot && is_in_triangle(triangle, at)) return true;
  }
  return false;
}

}  // namespace parvis::dressing
