// The module `gdal`: what of this room knows GDAL and libtiff.
#pragma once

#include "base/module.h"
#include "formats/terrain/height_grid.h"

namespace parvis::scene {

/// The functions of the module that calls GDAL.
struct GdalFunctions {
  Result<HeightGrid> (*read)(const std::filesystem::path& file, std::optional<double> cell_m,
                             Errors& warnings, const std::string& map);
};

/// Loaded in the workers' server when the first GeoTIFF is read.
inline constexpr Module<GdalFunctions> gdal("gdal");

}  // namespace parvis::scene
