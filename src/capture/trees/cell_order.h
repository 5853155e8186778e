// The order in which an eye sees a grid's cells: exact from every place, and fast enough for every frame.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/trees/cell_grid.h"

namespace parvis::trees {

/// Sorts by counting; keeps its memory between calls.
class CellOrder {
 public:
  /// The grid's cells from back to front as an eye (in the grid's frame) sees them: of two cells that a ray
  /// from the eye passes, the farther comes first.
  void back_to_front(const CellGrid& grid, glm::vec3 eye, std::vector<std::uint32_t>& order);

 private:
  std::vector<std::uint32_t> other_, first_;
};

}  // namespace parvis::trees
