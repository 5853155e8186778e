#include "capture/trees/billboard_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/colour.h"
#include "base/parallel.h"
#include "capture/trees/cell_order.h"

namespace parvis::trees {
namespace {

constexpr int band_rows = 16;

float angle_between(glm::vec3 a, glm::vec3 b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The linear light of each byte of a colour.
std::array<float, 256> linear_of_bytes() {
  std::array<float, 256> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = linear_from_srgb(float(i) / 255.0f);
  return values;
}

}  // namespace

BillboardFrame billboard_frame(glm::vec3 centre, glm::vec3 cell_size_m, glm::vec3 eye) {
  BillboardFrame frame{};
  frame.to_eye = glm::normalize(eye - centre);
  frame.right = display::billboard_right(frame.to_eye);
  frame.up = display::billboard_up(frame.to_eye, frame.right);
  frame.half_size_m = display::billboard_half_size(frame.right, frame.up, 0.5f * cell_size_m);
  frame.slants = display::silhouette_slants(frame.right, frame.up, 0.5f * cell_size_m);
  return frame;
}

glm::vec4 texture_colour(const BillboardTree& tree, const BillboardTextures& view, std::size_t cell,
                         glm::vec2 place) {
  static const std::array<float, 256> linear = linear_of_bytes();
  const auto premultiplied = [&](const std::uint8_t* t, float weight) {
    const float alpha = weight * float(t[3]) / 255.0f;
    return alpha * glm::vec4(linear[t[0]], linear[t[1]], linear[t[2]], 1.0f);
  };
  const std::int32_t texture = view.texture_of_cell[cell];
  if (texture < 0) return premultiplied(&tree.base[cell].x, 1.0f);
  const int side = tree.texels_per_side;
  const std::uint8_t* texels = view.texels.data() + 4 * std::size_t(texture) * std::size_t(side * side);
  const Footprint footprint(display::billboard_uv(place), side);
  glm::vec4 sum(0.0f);
  for (std::size_t k = 0; k < 4; ++k)
    sum += premultiplied(texels + 4 * footprint.texel[k], footprint.weight[k]);
  return sum;
}

std::vector<PlacedBillboard> placed_billboards(const CellGrid& grid, const Pinhole& camera,
                                               bool is_back_to_front) {
  std::vector<std::uint32_t> order;
  CellOrder().back_to_front(grid, camera.position_in_world, order);
  if (!is_back_to_front) std::ranges::reverse(order);
  const glm::ivec2 size(camera.width, camera.height);
  std::vector<PlacedBillboard> placed;
  placed.reserve(order.size());
  for (const std::uint32_t cell : order) {
    const glm::vec3 centre = grid.centre(cell);
    const BillboardFrame frame = billboard_frame(centre, grid.cell_size_m(), camera.position_in_world);
    const glm::vec2 half = frame.half_size_m;
    const glm::vec3 middle = camera.project(centre), to_right = camera.project(centre + half.x * frame.right),
                    upward = camera.project(centre + half.y * frame.up);
    if (middle.z <= 0.0f || to_right.z <= 0.0f || upward.z <= 0.0f) continue;
    const glm::vec2 a = glm::vec2(to_right - middle) / half.x, b = glm::vec2(upward - middle) / half.y;
    const float area = a.x * b.y - a.y * b.x;
    if (std::abs(area) < 1e-12f) continue;
    const glm::vec2 reach = glm::abs(a) * half.x + glm::abs(b) * half.y;
    const glm::ivec2 low = glm::max(glm::ivec2(glm::floor(glm::vec2(middle) - reach)), glm::ivec2(0));
    const glm::ivec2 high = glm::min(glm::ivec2(glm::ceil(glm::vec2(middle) + reach)), size);
    if (glm::any(glm::greaterThanEqual(low, high))) continue;
    placed.push_back({cell, glm::vec2(middle), glm::inverse(glm::mat2(a, b)), half, frame.slants, low, high});
  }
  return placed;
}

ClosestViews closest_views(const BillboardTree& tree, glm::vec3 point, glm::vec3 to_eye, int cell) {
  // The three greatest cosines.
  std::array<float, 3> cosines{-2.0f, -2.0f, -2.0f};
  std::array<int, 3> nearest{0, 0, 0};
  int count = 0;
  for (std::size_t i = 0; i < tree.views.size(); ++i) {
    if (cell != no_cell && tree.views[i].texture_of_cell[std::size_t(cell)] < 0) continue;
    ++count;
    const glm::vec3 to_camera = tree.views[i].camera.position_in_world - point;
    float cosine = glm::dot(to_eye, to_camera) * glm::inversesqrt(glm::dot(to_camera, to_camera));
    int view = int(i);
    for (std::size_t k = 0; k < 3; ++k)
      if (cosine > cosines[k]) std::swap(cosine, cosines[k]), std::swap(view, nearest[k]);
  }
  ClosestViews result;
  if (count == 0 && cell != no_cell) return closest_views(tree, point, to_eye);
  result.views = {nearest[0], nearest[0]};
  if (count < 2) return result;
  glm::vec3 angles(3.1415927f);
  for (int k = 0; k < 3 && k < count; ++k)
    angles[k] = angle_between(
        to_eye, tree.views[std::size_t(nearest[std::size_t(k)])].camera.position_in_world - point);
  result.views = {nearest[0], nearest[1]};
  const glm::vec2 weights = display::two_closest_weights(angles);
  result.weights = {weights.x, weights.y};
  return result;
}

ImageF render_billboards(const BillboardTree& tree, const Pinhole& camera) {
  ImageF picture(camera.width, camera.height, 4);
  if (tree.views.empty()) return picture;
  const std::vector<PlacedBillboard> placed = placed_billboards(tree.grid, camera, true);
  std::vector<ClosestViews> closest(tree.grid.size());
  parallel_for(
      tree.grid.size(),
      [&](std::size_t cell) {
        const glm::vec3 centre = tree.grid.centre(cell);
        closest[cell] =
            closest_views(tree, centre, glm::normalize(camera.position_in_world - centre), int(cell));
      },
      256);
  parallel_for(std::size_t((camera.height + band_rows - 1) / band_rows), [&](std::size_t band) {
    const int row0 = int(band) * band_rows, row1 = std::min(row0 + band_rows, camera.height);
    for (const PlacedBillboard& b : placed)
      visit_pixels(b, row0, row1, [&](int x, int y, glm::vec2 place) {
        glm::vec4 colour(0.0f);
        const ClosestViews& near = closest[b.cell];
        for (std::size_t v = 0; v < 2; ++v)
          if (near.weights[v] > 0.0f)
            colour +=
                near.weights[v] * texture_colour(tree, tree.views[std::size_t(near.views[v])], b.cell, place);
        float* p = picture.at(x, y);
        const glm::vec4 blended = display::over(colour, {p[0], p[1], p[2], p[3]});
        for (int k = 0; k < 4; ++k) p[k] = blended[k];
      });
  });
  return picture;
}

}  // namespace parvis::trees
