// Grids of heights (GeoTIFF) through GDAL.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::scene {

/// Samples row by row, the first row in the north.
struct HeightGrid {
  int columns = 0, rows = 0;
  std::vector<glm::dvec3> points;  ///< metres on the map, or about the grid's middle; z is NaN in holes
  bool has_place = false;          ///< on the map
  int file_columns = 0, file_rows = 0, bands = 1;  ///< of the file
  std::size_t undeclared_holes =
      0;                        ///< samples of a value that stands for holes, though the file does not say so
  double height_unit_m = 1.0;   ///< of the file
  std::string map;              ///< as Model::map
  double true_north_deg = 0.0;  ///< as Model::true_north_deg, in the middle
  std::optional<glm::dvec2> place_deg;  ///< of the middle: degrees, east and north

  const glm::dvec3& at(int column, int row) const {
    return points[std::size_t(row) * std::size_t(columns) + std::size_t(column)];
  }
};

/// All is laid on `map` (map_projection.h); without one, or where the file's own system is not known, it
/// stays on its own, and degrees become metres of the UTM zone. Heights are in the unit that the band names,
/// else in that of the vertical system. Samples that a mask, alpha or a value leaves out are holes. Of a grid
/// of more than 1000 samples across every n-th is taken, at its own place, which `warnings` report. A grid
/// without a place on the earth needs `cell_m`, the metres between its samples. Errors: no GeoTIFF, no place
/// and no `cell_m`, no height at all.
Result<HeightGrid> read_height_grid(const std::filesystem::path& file, std::optional<double> cell_m,
                                    Errors& warnings, const std::string& map = {});

}  // namespace parvis::scene
