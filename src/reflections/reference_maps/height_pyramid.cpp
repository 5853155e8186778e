#include "reflections/reference_maps/height_pyramid.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace parvis::reference_maps {
namespace {

using namespace shading;  // vec2, floor and the like, which the shared file takes for granted

/// Gives the shared functions the heights that a shader has in its sampler.
struct Walker {
  const std::vector<ImageF>& levels;

  float cell_height(ivec2 cell, int level) const { return *levels[std::size_t(level)].at(cell.x, cell.y); }

#include "reflections/reference_maps/heightfield_walk.glsl"

  static HeightfieldGrid grid_of(const HeightPyramid& pyramid) {
    return {pyramid.origin(), pyramid.cell_m(), pyramid.cells(), int(pyramid.levels().size()) - 1};
  }
};

reference_maps::HeightHit outside(const Walker::HeightHit& hit) { return {hit.distance, HitKind(hit.kind)}; }

/// Half as large each way; each cell the highest of the four below it.
ImageF maxima(const ImageF& fine) {
  ImageF coarse(std::max(fine.width / 2, 1), std::max(fine.height / 2, 1), 1);
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      const int x0 = std::min(2 * x, fine.width - 1), x1 = std::min(2 * x + 1, fine.width - 1);
      const int y0 = std::min(2 * y, fine.height - 1), y1 = std::min(2 * y + 1, fine.height - 1);
      *coarse.at(x, y) = std::max({*fine.at(x0, y0), *fine.at(x1, y0), *fine.at(x0, y1), *fine.at(x1, y1)});
    }
  return coarse;
}

}  // namespace

HeightPyramid::HeightPyramid(const shading::Heightfield& heightfield)
    : origin_(heightfield.bounds().min), cell_m_(heightfield.cell_m()) {
  const ImageF& heights = heightfield.heights();
  cells_ = {heights.width, heights.height};
  if (heights.empty()) return;
  levels_.emplace_back(int(std::bit_ceil(unsigned(cells_.x))), int(std::bit_ceil(unsigned(cells_.y))), 1,
                       std::numeric_limits<float>::lowest());
  for (int y = 0; y < cells_.y; ++y) std::copy_n(heights.at(0, y), cells_.x, levels_.front().at(0, y));
  while (levels_.back().width > 1 || levels_.back().height > 1) levels_.push_back(maxima(levels_.back()));
}

HeightHit HeightPyramid::walk(glm::vec3 origin, glm::vec3 direction, float reach_m) const {
  Walker walker{levels_};
  return outside(walker.walk_heightfield(Walker::grid_of(*this), origin, direction, reach_m));
}

HeightHit HeightPyramid::walk_by_levels(glm::vec3 origin, glm::vec3 direction, float reach_m) const {
  Walker walker{levels_};
  return outside(walker.walk_pyramid(Walker::grid_of(*this), origin, direction, reach_m));
}

HeightHit HeightPyramid::walk_to_cell(glm::vec3 origin, glm::vec3 direction, float reach_m) const {
  Walker walker{levels_};
  return outside(walker.walk_to_cell(Walker::grid_of(*this), origin, direction, reach_m));
}

}  // namespace parvis::reference_maps
