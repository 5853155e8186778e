// Plan rasters: rasterised ground polygons, and distances between cells.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace parvis::scene {

/// A grid of square cells in plan, metres. Cell (x, y) covers origin + cell_m * [x, x + 1) x [y, y + 1).
struct GroundGrid {
  int width = 0, height = 0;
  float cell_m = 1.0f;
  glm::vec2 origin{0.0f};

  bool contains(int x, int y) const { return x >= 0 && x < width && y >= 0 && y < height; }
  glm::vec2 centre_of(glm::ivec2 cell) const { return origin + cell_m * (glm::vec2(cell) + 0.5f); }
  glm::ivec2 cell_at(glm::vec2 point) const { return glm::ivec2(glm::floor((point - origin) / cell_m)); }
};

/// A grid with one value per cell, row by row.
template <class T>
struct GroundRaster : GroundGrid {
  std::vector<T> cells;

  GroundRaster() = default;
  GroundRaster(const GroundGrid& grid, T fill)
      : GroundGrid(grid), cells(std::size_t(grid.width) * std::size_t(grid.height), fill) {}
  GroundRaster(int w, int h, float cell, glm::vec2 start, T fill) : GroundRaster({w, h, cell, start}, fill) {}

  /// The value of a cell, which must lie in the grid.
  T& at(int x, int y) { return cells[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
  /// The value of a cell, which must lie in the grid.
  const T& at(int x, int y) const { return cells[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

/// A binary raster: 0 or 1.
using Mask = GroundRaster<unsigned char>;

/// The cells of `grid` whose centres lie inside the rings (even-odd rule: inner rings are holes).
std::vector<glm::ivec2> cells_inside(const GroundGrid& grid, std::span<const std::vector<glm::vec3>> rings);

/// Distance in metres from each cell to the centre of the nearest cell whose mask equals `target`; very
/// large if there is none. Exact (Felzenszwalb and Huttenlocher 2012: Distance transforms of sampled
/// functions).
GroundRaster<float> distances_to(const Mask& mask, unsigned char target);

/// The mask with gaps up to `gap_m` wide closed and holes smaller than `hole_m2` filled.
Mask closed(const Mask& mask, float gap_m, float hole_m2);

}  // namespace parvis::scene
