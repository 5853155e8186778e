#include "capture/trees/billboard_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "capture/trees/billboard_math.h"

namespace parvis::trees {
namespace {

constexpr int band_rows = 16;

/// Cells from back to front as an eye sees them. Of a regular grid the order by |distance of the cells'
/// indices from the eye's|, one axis after the other, is exact: no ray goes through a cell of smaller keys
/// before one of larger.
std::vector<std::uint32_t> back_to_front(const CellGrid& grid, glm::vec3 eye) {
  const glm::ivec3 at(glm::floor(glm::clamp((eye - grid.box().min) / grid.cell_size_m(), -2e4f, 2e4f)));
  std::vector<std::uint64_t> keys(grid.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const glm::ivec3 d = glm::abs(glm::ivec3(grid.cells()[i]) - at);
    keys[i] = std::uint64_t(d.z) << 48 | std::uint64_t(d.y) << 32 | std::uint64_t(d.x) << 16;
  }
  std::vector<std::uint32_t> order(grid.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
  return order;
}

float angle_between(glm::vec3 a, glm::vec3 b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// A texture's colour at a point of a billboard, premultiplied. Beyond its edge it is transparent.
glm::vec4 sample(const BillboardTree& tree, const BillboardTextures& view, std::uint32_t cell,
                 glm::vec2 half_size_m, glm::vec2 metres) {
  if (std::abs(metres.x) > half_size_m.x || std::abs(metres.y) > half_size_m.y) return glm::vec4(0.0f);
  const std::int32_t texture = view.texture_of_cell[cell];
  if (texture < 0) {
    const glm::vec4 base = glm::vec4(tree.base[cell]) / 255.0f;
    return {glm::vec3(base) * base.w, base.w};
  }
  const int side = tree.texels_per_side;
  const std::uint8_t* texels = view.texels.data() + 4 * std::size_t(texture) * std::size_t(side * side);
  const Footprint footprint(display::billboard_uv(metres, half_size_m), side);
  glm::vec4 sum(0.0f);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint8_t* t = texels + 4 * footprint.texel[k];
    const float alpha = footprint.weight[k] * float(t[3]) / 255.0f;
    sum += glm::vec4(glm::vec3(float(t[0]), float(t[1]), float(t[2])) * (alpha / 255.0f), alpha);
  }
  return sum;
}

}  // namespace

glm::vec2 billboard_half_size_towards(const CellGrid& grid, std::size_t cell, glm::vec3 eye) {
  const glm::vec3 to_eye = glm::normalize(eye - grid.centre(cell)), right = display::billboard_right(to_eye);
  return display::billboard_half_size(right, display::billboard_up(to_eye, right), 0.5f * grid.cell_size_m());
}

std::vector<PlacedBillboard> placed_billboards(const CellGrid& grid, const Pinhole& camera,
                                               bool is_back_to_front) {
  std::vector<std::uint32_t> order = back_to_front(grid, camera.position_in_world);
  if (!is_back_to_front) std::ranges::reverse(order);
  const glm::ivec2 size(camera.width, camera.height);
  std::vector<PlacedBillboard> placed;
  placed.reserve(order.size());
  for (const std::uint32_t cell : order) {
    const glm::vec3 centre = grid.centre(cell), to_eye = glm::normalize(camera.position_in_world - centre);
    const glm::vec3 right = display::billboard_right(to_eye), up = display::billboard_up(to_eye, right);
    const glm::vec2 half = display::billboard_half_size(right, up, 0.5f * grid.cell_size_m());
    const glm::vec3 middle = camera.project(centre), to_right = camera.project(centre + half.x * right),
                    upward = camera.project(centre + half.y * up);
    if (middle.z <= 0.0f || to_right.z <= 0.0f || upward.z <= 0.0f) continue;
    const glm::vec2 a = glm::vec2(to_right - middle) / half.x, b = glm::vec2(upward - middle) / half.y;
    const float area = a.x * b.y - a.y * b.x;
    if (std::abs(area) < 1e-12f) continue;
    const glm::vec2 reach = glm::abs(a) * half.x + glm::abs(b) * half.y;
    const glm::ivec2 low = glm::max(glm::ivec2(glm::floor(glm::vec2(middle) - reach)), glm::ivec2(0));
    const glm::ivec2 high = glm::min(glm::ivec2(glm::ceil(glm::vec2(middle) + reach)), size);
    if (glm::any(glm::greaterThanEqual(low, high))) continue;
    placed.push_back({cell, glm::vec2(middle), glm::inverse(glm::mat2(a, b)), half, low, high});
  }
  return placed;
}

ClosestViews closest_views(const BillboardTree& tree, glm::vec3 eye) {
  const glm::vec3 middle = tree.grid.box().centre(), direction = glm::normalize(eye - middle);
  std::vector<std::pair<float, int>> angles;
  for (std::size_t i = 0; i < tree.views.size(); ++i)
    angles.emplace_back(
        angle_between(direction, glm::normalize(tree.views[i].camera.position_in_world - middle)), int(i));
  std::partial_sort(angles.begin(), angles.begin() + std::min<std::ptrdiff_t>(3, std::ssize(angles)),
                    angles.end());
  ClosestViews result;
  if (angles.empty()) return result;
  result.views = {angles[0].second, angles.size() > 1 ? angles[1].second : angles[0].second};
  if (angles.size() > 1) {
    const float third = angles.size() > 2 ? angles[2].first : 3.1415927f;
    const glm::vec2 weights = display::two_closest_weights({angles[0].first, angles[1].first, third});
    result.weights = {weights.x, weights.y};
  }
  return result;
}

ImageF render_billboards(const BillboardTree& tree, const Pinhole& camera) {
  ImageF picture(camera.width, camera.height, 4);
  if (tree.views.empty()) return picture;
  const std::vector<PlacedBillboard> placed = placed_billboards(tree.grid, camera, true);
  const ClosestViews closest = closest_views(tree, camera.position_in_world);
  std::array<std::vector<glm::vec2>, 2> half_sizes;
  for (std::size_t v = 0; v < 2; ++v)
    for (std::size_t cell = 0; cell < tree.grid.size(); ++cell)
      half_sizes[v].push_back(billboard_half_size_towards(
          tree.grid, cell, tree.views[std::size_t(closest.views[v])].camera.position_in_world));
  parallel_for(std::size_t((camera.height + band_rows - 1) / band_rows), [&](std::size_t band) {
    const int row0 = int(band) * band_rows, row1 = std::min(row0 + band_rows, camera.height);
    for (const PlacedBillboard& b : placed)
      visit_pixels(b, row0, row1, [&](int x, int y, glm::vec2 metres) {
        glm::vec4 colour(0.0f);
        for (std::size_t v = 0; v < 2; ++v)
          if (closest.weights[v] > 0.0f)
            colour += closest.weights[v] * sample(tree, tree.views[std::size_t(closest.views[v])], b.cell,
                                                  half_sizes[v][b.cell], metres);
        float* p = picture.at(x, y);
        const glm::vec4 blended = display::over(colour, {p[0], p[1], p[2], p[3]});
        for (int k = 0; k < 4; ++k) p[k] = blended[k];
      });
  });
  return picture;
}

}  // namespace parvis::trees
