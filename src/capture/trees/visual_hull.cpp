#include "capture/trees/visual_hull.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "base/parallel.h"

namespace parvis::trees {
namespace {

constexpr int box_branchings = 7;     // of the first search: 128 steps along each side
constexpr int box_refinements = 2;    // each looks again, 64 steps along each side of the box found before
constexpr int consistency_level = 5;  // octree level of the silhouettes' comparison: 32 cells along each side
constexpr float min_explained = 0.97f;   // share of a silhouette that cells of the hull have to cover
constexpr float min_improvement = 0.5f;  // of what is unexplained, by leaving out a view that is wrong

/// The cells of one level's cells that no view shows as empty.
std::vector<glm::u16vec3> subdivided(const std::vector<glm::u16vec3>& parents, int branching,
                                     const Bounds& box, int side, std::span<const Silhouette> silhouettes) {
  const int children = branching * branching * branching;
  const glm::vec3 cell_m = box.size() / float(side);
  std::vector<std::uint32_t> kept(parents.size(), 0);  // a bit per child
  parallel_for(
      parents.size(),
      [&](std::size_t i) {
        for (int c = 0; c < children; ++c) {
          const glm::ivec3 place =
              branching * glm::ivec3(parents[i]) +
              glm::ivec3(c % branching, c / branching % branching, c / (branching * branching));
          const glm::vec3 low = box.min + glm::vec3(place) * cell_m;
          const auto shows = [&](const Silhouette& s) { return s.may_show({low, low + cell_m}); };
          if (std::ranges::all_of(silhouettes, shows)) kept[i] |= 1u << c;
        }
      },
      16);
  std::vector<glm::u16vec3> cells;
  for (std::size_t i = 0; i < parents.size(); ++i)
    for (int c = 0; c < children; ++c)
      if (kept[i] >> c & 1u)
        cells.emplace_back(branching * glm::ivec3(parents[i]) +
                           glm::ivec3(c % branching, c / branching % branching, c / (branching * branching)));
  return cells;
}

std::vector<glm::u16vec3> hull_cells(const Bounds& box, int branching, int levels,
                                     std::span<const Silhouette> silhouettes) {
  std::vector<glm::u16vec3> cells{glm::u16vec3(0)};
  for (int level = 1, side = branching; level <= levels; ++level, side *= branching)
    cells = subdivided(cells, branching, box, side, silhouettes);
  return cells;
}

Bounds bounds_of(const std::vector<glm::u16vec3>& cells, const Bounds& box, int side) {
  Bounds result;
  const glm::vec3 cell_m = box.size() / float(side);
  for (const glm::u16vec3 cell : cells)
    result.add({box.min + glm::vec3(cell) * cell_m, box.min + (glm::vec3(cell) + 1.0f) * cell_m});
  return result;
}

/// A cube round the point that all look at, which reaches as far as the farthest camera.
Bounds first_box(std::span<const TreeView> views) {
  const glm::vec3 centre = point_looked_at(views);
  float reach = 0.0f;
  for (const TreeView& view : views)
    reach = std::max(reach, glm::distance(centre, view.camera.position_in_world));
  return {centre - reach, centre + reach};
}

}  // namespace

Silhouette::Silhouette(const TreeView& view) : camera_(view.camera) {
  const int width = view.picture.width, height = view.picture.height;
  sums_.assign(std::size_t(width + 1) * std::size_t(height + 1), 0);
  for (int y = 0; y < height; ++y) {
    const std::uint32_t* above = sums_.data() + std::size_t(y) * std::size_t(width + 1);
    std::uint32_t* row = sums_.data() + std::size_t(y + 1) * std::size_t(width + 1);
    std::uint32_t sum = 0;
    for (int x = 0; x < width; ++x) sum += view.picture.at(x, y)[3], row[x + 1] = above[x + 1] + sum;
  }
  const glm::ivec2 size(width, height);
  const std::uint32_t inner = width > 2 && height > 2 ? this->sum({1, 1}, size - 1) : 0;
  // The foot of a trunk may leave the picture; a matte that is cut off shows more than a few pixels at the
  // edge.
  is_cut_off_ = sums_.back() - inner > 255u * std::uint32_t(width + height) / 200u;
}

std::uint32_t Silhouette::sum(glm::ivec2 low, glm::ivec2 high) const {
  const auto at = [&](int x, int y) {
    return sums_[std::size_t(y) * std::size_t(camera_.width + 1) + std::size_t(x)];
  };
  return at(high.x, high.y) - at(low.x, high.y) - at(high.x, low.y) + at(low.x, low.y);
}

Silhouette::Rectangle Silhouette::rectangle(const Bounds& box) const {
  glm::vec2 low(1e30f), high(-1e30f);
  int behind = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 seen =
        camera_.project({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                         corner & 4 ? box.max.z : box.min.z});
    if (seen.z <= 0.0f) {
      ++behind;
      continue;
    }
    low = glm::min(low, glm::vec2(seen)), high = glm::max(high, glm::vec2(seen));
  }
  const glm::vec2 size(float(camera_.width), float(camera_.height));
  if (behind == 8) return {{0, 0}, {0, 0}, !is_cut_off_};
  if (behind > 0) return {{0, 0}, {0, 0}, false};
  const bool is_whole = low.x >= 0.0f && low.y >= 0.0f && high.x <= size.x && high.y <= size.y;
  return {glm::ivec2(glm::floor(glm::clamp(low, glm::vec2(0.0f), size))),
          glm::ivec2(glm::ceil(glm::clamp(high, glm::vec2(0.0f), size))), is_whole || !is_cut_off_};
}

bool Silhouette::may_show(const Bounds& box) const {
  const Rectangle r = rectangle(box);
  return !r.is_known || sum(r.low, r.high) > 0;
}

float Silhouette::mean_alpha(const Bounds& box) const {
  const Rectangle r = rectangle(box);
  const int area = (r.high.x - r.low.x) * (r.high.y - r.low.y);
  return !r.is_known ? 1.0f : area <= 0 ? 0.0f : float(sum(r.low, r.high)) / (255.0f * float(area));
}

std::vector<Silhouette> silhouettes(std::span<const TreeView> views) {
  std::vector<Silhouette> result;
  result.reserve(views.size());
  for (const TreeView& view : views) result.emplace_back(view);
  return result;
}

Result<Bounds> hull_box(std::span<const TreeView> views, std::span<const Silhouette> silhouettes) {
  if (views.size() < 3)
    return error("{} photographs of the tree: at least 3 are needed, 20 to 30 are recommended", views.size());
  for (std::size_t i = 0; i < views.size(); ++i)
    if (silhouettes[i].is_empty()) return error("{}: the matte is empty, it shows no tree", views[i].name);
  Bounds box = first_box(views);
  for (int pass = 0; pass <= box_refinements; ++pass) {
    const int levels = pass == 0 ? box_branchings : box_branchings - 1, side = 1 << levels;
    const std::vector<glm::u16vec3> cells = hull_cells(box, 2, levels, silhouettes);
    if (cells.empty())
      return error(
          "the photographs' silhouettes have no point in common: cameras or mattes are wrong, more than one "
          "of "
          "them, or one that --keep-inconsistent keeps");
    box = bounds_of(cells, box, side);
  }
  return box;
}

Result<CellGrid> hull_grid(std::span<const TreeView> views, std::span<const Silhouette> silhouettes,
                           const Bounds& box, const GridOptions& options) {
  const double side = std::pow(options.branching, options.level);
  if (side > max_grid_side)
    return error("a grid of {} levels of {} has {:.0f} cells along each side; at most {} are possible",
                 options.level, options.branching, side, max_grid_side);
  for (const TreeView& view : views) {
    const glm::vec3 p = view.camera.position_in_world;
    if (glm::all(glm::greaterThan(p, box.min)) && glm::all(glm::lessThan(p, box.max)))
      return error(
          "{}: the camera is inside of the tree's box ({:.2f} x {:.2f} x {:.2f} m): its position is wrong, "
          "or the "
          "tree fills more than the other photographs show",
          view.name, box.size().x, box.size().y, box.size().z);
  }
  return CellGrid(box, options.branching, int(side),
                  hull_cells(box, options.branching, options.level, silhouettes));
}

namespace {

/// Share of a view's alpha that lies where some cell of the hull projects, on a coarse picture.
float explained_share(const TreeView& view, const std::vector<Bounds>& cells) {
  const int factor = std::max(1, view.picture.width / 160);
  const ImageF alpha = reduced_alpha(view.picture, factor);
  const Pinhole camera = reduced(view.camera, factor);
  std::vector<std::uint8_t> is_covered(alpha.pixels.size(), 0);
  for (const Bounds& cell : cells) {
    glm::vec2 low(1e30f), high(-1e30f);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 seen =
          camera.project({corner & 1 ? cell.max.x : cell.min.x, corner & 2 ? cell.max.y : cell.min.y,
                          corner & 4 ? cell.max.z : cell.min.z});
      low = glm::min(low, glm::vec2(seen)), high = glm::max(high, glm::vec2(seen));
    }
    const int x1 = std::min(alpha.width, int(std::ceil(high.x))),
              y1 = std::min(alpha.height, int(std::ceil(high.y)));
    for (int y = std::max(0, int(std::floor(low.y))); y < y1; ++y)
      for (int x = std::max(0, int(std::floor(low.x))); x < x1; ++x)
        is_covered[std::size_t(y) * std::size_t(alpha.width) + std::size_t(x)] = 1;
  }
  double covered = 0.0, all = 0.0;
  for (std::size_t i = 0; i < alpha.pixels.size(); ++i)
    all += double(alpha.pixels[i]), covered += is_covered[i] ? double(alpha.pixels[i]) : 0.0;
  return all > 0.0 ? float(covered / all) : 1.0f;
}

/// Worst explained share over the views but `without`, by the hull of the views but `without`.
float worst_explained(std::span<const TreeView> views, const std::vector<Bounds>& cells,
                      const std::vector<std::vector<std::uint32_t>>& emptied_by, std::size_t without) {
  std::vector<Bounds> hull;
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (emptied_by[c].empty() || (emptied_by[c].size() == 1 && emptied_by[c][0] == without))
      hull.push_back(cells[c]);
  float worst = 1.0f;
  for (std::size_t i = 0; i < views.size(); ++i)
    if (i != without) worst = std::min(worst, explained_share(views[i], hull));
  return worst;
}

}  // namespace

std::vector<std::size_t> inconsistent_views(std::span<const TreeView> views,
                                            std::span<const Silhouette> silhouettes) {
  if (views.size() < 4) return {};
  // Cells that at most one view empties; which one.
  const Bounds whole = first_box(views);
  std::vector<glm::u16vec3> places{glm::u16vec3(0)};
  std::vector<Bounds> cells;
  std::vector<std::vector<std::uint32_t>> emptied_by;
  Bounds box = whole;
  for (int pass = 0; pass < 2; ++pass) {  // the second in the box that the first finds
    places = {glm::u16vec3(0)};
    for (int level = 1; level <= consistency_level + 1; ++level) {
      const int side = 1 << level;
      const glm::vec3 cell_m = box.size() / float(side);
      std::vector<glm::u16vec3> next;
      cells.clear(), emptied_by.clear();
      for (const glm::u16vec3 parent : places)
        for (int c = 0; c < 8; ++c) {
          const glm::ivec3 place = 2 * glm::ivec3(parent) + glm::ivec3(c & 1, c >> 1 & 1, c >> 2);
          const glm::vec3 low = box.min + glm::vec3(place) * cell_m;
          std::vector<std::uint32_t> emptied;
          for (std::uint32_t i = 0; i < views.size() && emptied.size() < 2; ++i)
            if (!silhouettes[i].may_show({low, low + cell_m})) emptied.push_back(i);
          if (emptied.size() >= 2) continue;
          next.emplace_back(place), cells.push_back({low, low + cell_m}),
              emptied_by.push_back(std::move(emptied));
        }
      places = std::move(next);
    }
    if (places.empty()) return {};
    if (pass == 0) box = bounds_of(places, box, 1 << (consistency_level + 1));
  }
  const float all = worst_explained(views, cells, emptied_by, views.size());
  if (all >= min_explained) return {};
  std::vector<float> without(views.size());
  parallel_for(views.size(),
               [&](std::size_t i) { without[i] = worst_explained(views, cells, emptied_by, i); });
  std::vector<std::size_t> wrong;
  const std::size_t best = std::size_t(std::ranges::max_element(without) - without.begin());
  if (1.0f - without[best] <= (1.0f - min_improvement) * (1.0f - all)) wrong.push_back(best);
  return wrong;
}

}  // namespace parvis::trees
