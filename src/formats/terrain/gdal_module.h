// The module `gdal`: what of this room knows GDAL and libtiff.
#pragma once

#include "base/module.h"
#include "formats/terrain/height_grid.h"
#include "formats/terrain/map_raster.h"

namespace parvis::scene {

/// The functions of the module that calls GDAL.
struct GdalFunctions {
  Result<HeightGrid> (*read)(const std::filesystem::path& file, std::optional<double> cell_m,
                             Errors& warnings, const std::string& map);
  Result<std::string> (*write)(const MapRaster& raster);
};

/// Loaded in the workers' server when the first GeoTIFF is read, in the program where one is written.
inline constexpr Module<GdalFunctions> gdal("gdal");

}  // namespace parvis::scene
