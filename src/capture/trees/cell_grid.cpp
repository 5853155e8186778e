#include "capture/trees/cell_grid.h"

#include <cassert>

namespace parvis::trees {

CellGrid::CellGrid(const Bounds& box, int branching, int side, std::vector<glm::u16vec3> cells)
    : box_(box), branching_(branching), side_(side), cells_(std::move(cells)) {
  assert(side >= 1 && side <= max_grid_side);
  const int full_brick = branching == 2 ? 8 : 9;
  brick_side_ = side % full_brick == 0 ? full_brick : side;
  bricks_ = side / brick_side_;
  brick_at_.assign(std::size_t(bricks_) * std::size_t(bricks_) * std::size_t(bricks_), -1);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const glm::ivec3 place(cells_[i]), brick = place / brick_side_, within = place - brick * brick_side_;
    std::int32_t& first = brick_at_[brick_index(brick)];
    if (first < 0) {
      first = std::int32_t(cell_at_.size());
      cell_at_.resize(cell_at_.size() + std::size_t(brick_side_ * brick_side_ * brick_side_), no_cell);
    }
    cell_at_[index_in_brick(first, within)] = std::int32_t(i);
  }
}

Bounds CellGrid::bounds(std::size_t cell) const {
  const glm::vec3 low = box_.min + glm::vec3(cells_[cell]) * cell_size_m();
  return {low, low + cell_size_m()};
}

int CellGrid::cell_at(glm::ivec3 place) const {
  if (glm::any(glm::lessThan(place, glm::ivec3(0))) ||
      glm::any(glm::greaterThanEqual(place, glm::ivec3(side_))))
    return no_cell;
  const glm::ivec3 brick = place / brick_side_, within = place - brick * brick_side_;
  const std::int32_t first = brick_at_[brick_index(brick)];
  return first < 0 ? no_cell : cell_at_[index_in_brick(first, within)];
}

}  // namespace parvis::trees
