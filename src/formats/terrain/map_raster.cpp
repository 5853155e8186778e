#include "formats/terrain/map_raster.h"

#include "formats/terrain/gdal_module.h"
#include "formats/terrain/map_system.h"

namespace parvis::scene {

Result<std::string> encode_geotiff(const MapRaster& raster) {
  if (const Status known = projections_known(); !known) return known.errors();
  return gdal.call(&GdalFunctions::write, raster);
}

}  // namespace parvis::scene
