// Rasters of computed values on a map, written as GeoTIFF through GDAL.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::scene {

/// Bands of square cells, the first row in the north.
struct MapRaster {
  /// The value of cells without one.
  static constexpr float nothing = -9999.0f;
  /// A name, and columns * rows values.
  struct Band {
    std::string name;
    std::vector<float> values;
  };
  int columns = 0, rows = 0;
  double cell_m = 1.0;
  glm::dvec2 corner{0.0};  ///< upper left, in metres on the map
  std::string map = {};    ///< as Model::map; empty: without a coordinate system
  std::vector<Band> bands = {};
};

/// The bytes of a GeoTIFF. Errors: GDAL cannot be loaded or written with; the map's system is unknown to it.
Result<std::string> encode_geotiff(const MapRaster& raster);

}  // namespace parvis::scene
