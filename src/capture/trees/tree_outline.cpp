#include "capture/trees/tree_outline.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "base/cut_polygon.h"
#include "base/parallel.h"

namespace parvis::trees {
namespace {

constexpr int half_turn = TreeSlice::directions / 2;
constexpr float far_m = 1e6f;

int slice_at(const TreeOutline& outline, float z) {
  return std::clamp(int((z - outline.foot_m) / outline.slice_height_m()), 0, TreeOutline::slice_count - 1);
}

/// How much of the last bin of a row is covered.
float covered(float last, float before) { return last / std::max({last, before, 1e-6f}); }

/// Opacities along one horizontal direction: a row of bins per layer of cells.
struct SideView {
  float first_m, bin_m;  // where the bins begin, along the direction; their width
  int bins;
  std::vector<float> alpha;  // layers x bins

  std::span<const float> row(int layer) const {
    return std::span(alpha).subspan(std::size_t(layer) * std::size_t(bins), std::size_t(bins));
  }
};

/// The outline in a horizontal view across `along`.
SideView side_view(const TreeVolume& volume, glm::vec2 along) {
  const CellGrid& grid = volume.grid;
  const glm::vec3 size = grid.cell_size_m();
  const Bounds box = grid.box();
  SideView view;
  view.bin_m = std::max(size.x, size.y);
  const float half_m = glm::dot(glm::abs(along), 0.5f * glm::vec2(box.size()));
  view.first_m = glm::dot(along, glm::vec2(box.centre())) - half_m;
  view.bins = int(2.0f * half_m / view.bin_m) + 1;
  view.alpha.assign(std::size_t(grid.side()) * std::size_t(view.bins), 0.0f);
  const float depth_of_extinction = size.x * size.y / view.bin_m;  // the cell's volume over the bin's face
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const float at = (glm::dot(along, glm::vec2(grid.centre(i))) - view.first_m) / view.bin_m;
    const int bin = std::clamp(int(at), 0, view.bins - 1);
    view.alpha[std::size_t(grid.cells()[i].z) * std::size_t(view.bins) + std::size_t(bin)] +=
        volume.extinction_per_m[i] * depth_of_extinction;
  }
  for (float& value : view.alpha) value = 1.0f - std::exp(-value);
  return view;
}

/// The foot and the top from the greatest opacity of each layer.
void set_heights(TreeOutline& outline, const CellGrid& grid, const std::vector<float>& peak,
                 float min_alpha) {
  const auto is_there = [&](float alpha) { return alpha >= min_alpha; };
  const auto low = std::ranges::find_if(peak, is_there);
  if (low == peak.end()) return;
  const auto high = std::find_if(peak.rbegin(), peak.rend(), is_there).base() - 1;
  const float height_m = grid.cell_size_m().z, base_m = grid.box().min.z;
  const float above = low + 1 < peak.end() ? low[1] : 0.0f, below = high > peak.begin() ? high[-1] : 0.0f;
  outline.foot_m = base_m + height_m * (float(low - peak.begin()) + 1.0f - covered(*low, above));
  outline.top_m = base_m + height_m * (float(high - peak.begin()) + covered(*high, below));
}

}  // namespace

glm::vec2 TreeSlice::direction(int index) {
  const float angle = 2.0f * glm::pi<float>() * float(index) / directions;
  return {std::cos(angle), std::sin(angle)};
}

void TreeSlice::widen(int direction, float reach_m) {
  float& reach = reach_m_[std::size_t(direction)];
  reach = std::max(reach, reach_m);
}

void TreeSlice::add(glm::vec2 point) {
  static const std::array<glm::vec2, directions> all = [] {
    std::array<glm::vec2, directions> result;
    for (int i = 0; i < directions; ++i) result[std::size_t(i)] = direction(i);
    return result;
  }();
  for (std::size_t i = 0; i < all.size(); ++i) reach_m_[i] = std::max(reach_m_[i], glm::dot(point, all[i]));
}

void TreeSlice::add(const TreeSlice& other) {
  for (int i = 0; i < directions; ++i) widen(i, other.reach_m_[std::size_t(i)]);
}

bool TreeSlice::empty() const { return std::ranges::find(reach_m_, nothing) != reach_m_.end(); }

float TreeSlice::mean_width_m() const {
  return empty() ? 0.0f : 2.0f * std::accumulate(reach_m_.begin(), reach_m_.end(), 0.0f) / directions;
}

float TreeSlice::hull_area_m2() const {
  if (empty()) return 0.0f;
  std::vector<glm::vec2> hull{{-far_m, -far_m}, {far_m, -far_m}, {far_m, far_m}, {-far_m, far_m}};
  for (int i = 0; i < directions; ++i) {
    const glm::vec2 along = direction(i);
    const float reach_m = reach_m_[std::size_t(i)];
    hull = cut(hull, [&](glm::vec2 p) { return reach_m - glm::dot(p, along); });
  }
  float twice_area = 0.0f;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const glm::vec2 a = hull[i], b = hull[(i + 1) % hull.size()];
    twice_area += a.x * b.y - a.y * b.x;
  }
  return 0.5f * twice_area;
}

TreeOutline outline_of(const TreeVolume& volume, float min_alpha) {
  const CellGrid& grid = volume.grid;
  TreeOutline outline;
  std::vector<SideView> views(half_turn);
  parallel_for(half_turn, [&](std::size_t i) { views[i] = side_view(volume, TreeSlice::direction(int(i))); });
  std::vector<float> peak(std::size_t(grid.side()), 0.0f);
  for (const SideView& view : views)
    for (int layer = 0; layer < grid.side(); ++layer)
      peak[std::size_t(layer)] = std::max(peak[std::size_t(layer)], std::ranges::max(view.row(layer)));
  set_heights(outline, grid, peak, min_alpha);
  if (outline.top_m <= outline.foot_m) return outline;
  outline.slices.resize(TreeOutline::slice_count);
  const float height_m = grid.cell_size_m().z;
  for (int i = 0; i < half_turn; ++i)
    for (int layer = 0; layer < grid.side(); ++layer) {
      const SideView& view = views[std::size_t(i)];
      const std::span<const float> row = view.row(layer);
      int low = 0, high = view.bins - 1;
      while (low < view.bins && row[std::size_t(low)] < min_alpha) ++low;
      if (low == view.bins) continue;
      while (row[std::size_t(high)] < min_alpha) --high;
      const auto at = [&](int bin) { return bin >= 0 && bin < view.bins ? row[std::size_t(bin)] : 0.0f; };
      const float end = float(high) + covered(at(high), at(high - 1)),
                  begin = float(low) + 1.0f - covered(at(low), at(low + 1));
      TreeSlice& slice =
          outline.slices[std::size_t(slice_at(outline, grid.box().min.z + (float(layer) + 0.5f) * height_m))];
      slice.widen(i, view.first_m + end * view.bin_m);
      slice.widen(i + half_turn, -(view.first_m + begin * view.bin_m));
    }
  return outline;
}

TreeOutline outline_of(std::span<const glm::vec3> points) {
  TreeOutline outline;
  if (points.empty()) return outline;
  const auto [lowest, highest] = std::ranges::minmax_element(points, {}, &glm::vec3::z);
  outline.foot_m = lowest->z, outline.top_m = highest->z;
  if (outline.top_m <= outline.foot_m) return outline;
  outline.slices.resize(TreeOutline::slice_count);
  for (const glm::vec3 p : points) outline.slices[std::size_t(slice_at(outline, p.z))].add(glm::vec2(p));
  return outline;
}

}  // namespace parvis::trees
