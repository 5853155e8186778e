// Of a regular grid the order by |distance of the cells' indices from the eye's|, one axis after the other,
// is exact: no ray goes through a cell of smaller keys before one of larger. Three stable passes of counting
// sort.
#include "capture/trees/cell_order.h"

#include <numeric>

namespace parvis::trees {

void CellOrder::back_to_front(const CellGrid& grid, glm::vec3 eye, std::vector<std::uint32_t>& order) {
  const int side = grid.side();
  const glm::ivec3 at(glm::clamp(glm::floor((eye - grid.box().min) / grid.cell_size_m()), glm::vec3(-1.0f),
                                 glm::vec3(float(side))));
  order.resize(grid.size()), other_.resize(grid.size());
  std::iota(order.begin(), order.end(), 0u);
  for (int axis = 0; axis < 3; ++axis) {
    // The greatest distance comes first.
    const auto key = [&](std::uint32_t cell) {
      return std::size_t(side + 1 - std::abs(int(grid.cells()[cell][axis]) - at[axis]));
    };
    first_.assign(std::size_t(side) + 3, 0);
    for (const std::uint32_t cell : order) ++first_[key(cell) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    for (const std::uint32_t cell : order) other_[first_[key(cell)]++] = cell;
    order.swap(other_);
  }
}

}  // namespace parvis::trees
