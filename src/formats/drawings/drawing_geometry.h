// The geometry of a drawing through GDAL's DXF driver.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "formats/drawings/drawing.h"
#include "formats/drawings/drawing_facts.h"

namespace parvis::formats {

/// The model space as GDAL reads it, in metres, about the file's own origin.
struct DrawingGeometry {
  /// The lines of each entity of which it drew something, by the entity's handle; of a placed block all lines
  /// of its contents.
  std::unordered_map<std::string, std::vector<std::size_t>> lines_of;
  bool has_handles = false;  ///< the file has them
  std::size_t far_away = 0;  ///< things that were left out because they lie beyond the earth
};

/// Adds lines, areas, texts and points to `drawing`, whose layers and unit are set; layers that the table
/// lacks are added. `dxf_text`: a text file in UTF-8. Errors: GDAL cannot read it at all.
Result<DrawingGeometry> add_geometry(const std::string& dxf_text, const DrawingFacts& facts,
                                     const std::string& file, Drawing& drawing);

}  // namespace parvis::formats
