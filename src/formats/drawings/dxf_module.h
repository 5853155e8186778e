// The module `dxf`: what of this room knows GDAL.
#pragma once

#include "base/module.h"
#include "formats/drawings/drawing_geometry.h"
#include "formats/drawings/dxf_writer.h"

namespace parvis::formats {

/// The functions of the module that calls GDAL's DXF driver.
struct DxfFunctions {
  Result<DrawingGeometry> (*add_geometry)(const std::string& dxf_text, const DrawingFacts& facts,
                                          const std::string& file, Drawing& drawing);
  Result<std::string> (*write)(const DxfPlan& plan);  ///< the file's bytes
};

/// Loaded in the workers' server when the first drawing is read, and in the program when it writes one.
inline constexpr Module<DxfFunctions> dxf("dxf");

/// The module's own `add_geometry`.
Result<DrawingGeometry> geometry_by_gdal(const std::string& dxf_text, const DrawingFacts& facts,
                                         const std::string& file, Drawing& drawing);
/// The module's own `write`.
Result<std::string> dxf_by_gdal(const DxfPlan& plan);

}  // namespace parvis::formats
