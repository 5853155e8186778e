// Writes plans as DXF through GDAL's driver, in metres.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::formats {

/// A polyline. Level ones become LWPOLYLINE, others 3D polylines: no area is written as such, for GDAL writes
/// sloping areas level and vertical ones not at all.
struct DxfLine {
  std::string layer;
  glm::u8vec3 colour{0};
  std::vector<glm::dvec3> points;  ///< metres; a closed one has its first point again at the end
};

/// A symbol of 1 x 1 m that is placed any number of times.
struct DxfBlock {
  std::string name;
  std::vector<std::vector<glm::dvec3>> lines;
};

/// A block at a place.
struct DxfInsert {
  std::string block, layer;
  glm::u8vec3 colour{0};
  glm::dvec3 position{0.0};
  glm::dvec3 size_m{1.0};  ///< along its own axes
  double angle_deg = 0.0;  ///< counter-clockwise from above
};

/// A line of text.
struct DxfText {
  std::string layer;
  std::string text;  ///< UTF-8
  glm::dvec3 position{0.0};
  double height_m = 0.5;
};

/// All that a plan holds.
struct DxfPlan {
  std::vector<DxfLine> lines;
  std::vector<DxfBlock> blocks;
  std::vector<DxfInsert> inserts;
  std::vector<DxfText> texts;
};

/// A name of a layer or block that every reader takes: letters, digits, '-' and '_' of ASCII, accents left
/// out.
std::string dxf_name(const std::string& name);

/// AutoCAD 2004 (AC1018) with $INSUNITS 6 (metres) and $MEASUREMENT 1. Names pass `dxf_name`. The file
/// appears whole or not at all.
Status write_dxf(const std::filesystem::path& file, const DxfPlan& plan);

}  // namespace parvis::formats
