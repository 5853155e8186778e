#include "formats/drawings/drawing_geometry.h"

#include "formats/drawings/dxf_module.h"

namespace parvis::formats {

Result<DrawingGeometry> add_geometry(const std::string& dxf_text, const DrawingFacts& facts,
                                     const std::string& file, Drawing& drawing) {
  return dxf.call(&DxfFunctions::add_geometry, dxf_text, facts, file, drawing);
}

}  // namespace parvis::formats
