// Grids of heights (GeoTIFF) through GDAL, the only file that knows it.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "base/result.h"

namespace parvis::scene {

/// Samples row by row, the first row in the north.
struct HeightGrid {
  int columns = 0, rows = 0;
  std::vector<glm::dvec3> points;  ///< metres on the map, or about the grid's middle; z is NaN in holes
  bool has_place = false;          ///< on the map

  const glm::dvec3& at(int column, int row) const {
    return points[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
  }
};

/// Degrees become metres of the UTM zone. Of a grid of more than 1000 samples across every n-th is taken,
/// which `warnings` tell. A grid without a place on the earth needs `cell_m`, the metres between its samples.
/// Errors: no GeoTIFF, no place and no `cell_m`, no height at all.
Result<HeightGrid> read_height_grid(const std::filesystem::path& file, std::optional<double> cell_m,
                                    Errors& warnings);

}  // namespace parvis::scene
