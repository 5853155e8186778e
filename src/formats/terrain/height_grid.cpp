#include "formats/terrain/height_grid.h"

#include "formats/terrain/gdal_module.h"
#include "formats/terrain/map_system.h"

namespace parvis::scene {

Result<HeightGrid> read_height_grid(const std::filesystem::path& file, std::optional<double> cell_m,
                                    Errors& warnings, const std::string& map) {
  if (const Status known = projections_known(); !known) return known.errors();
  return gdal.call(&GdalFunctions::read, file, cell_m, warnings, map);
}

}  // namespace parvis::scene
