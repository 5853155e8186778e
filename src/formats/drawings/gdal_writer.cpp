// GDAL's own header says inches and imperial; its text is taken with both settings changed, because a header
// written from nothing is what AutoCAD refuses.
#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>

#include <cmath>
#include <memory>

#include "base/files.h"
#include "formats/drawings/dxf_module.h"

namespace parvis::formats {
namespace {

constexpr const char* header_in_memory = "/vsimem/parvis_header.dxf";
constexpr const char* plan_in_memory = "/vsimem/parvis_plan.dxf";
constexpr std::uint64_t max_header_bytes = 1 << 20;

struct GdalInMemory {
  GdalInMemory() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~GdalInMemory() {
    CPLPopErrorHandler();
    VSIUnlink(header_in_memory);
    VSIUnlink(plan_in_memory);
  }
  GdalInMemory(const GdalInMemory&) = delete;
  GdalInMemory& operator=(const GdalInMemory&) = delete;
};

/// Sets an integer variable of the header's text.
bool set_variable(std::string& header, const std::string& name, int value) {
  std::size_t at = header.find(name + "\n");
  if (at == std::string::npos) at = header.find(name + "\r\n");
  if (at == std::string::npos) return false;
  at = header.find('\n', at) + 1;                       // its code
  const std::size_t begin = header.find('\n', at) + 1;  // its value
  const std::size_t end = header.find_first_of("\r\n", begin);
  if (begin == 0 || end == std::string::npos) return false;
  header.replace(begin, end - begin, fmt::format("{:6}", value));
  return true;
}

/// Puts the header with metres into memory.
Status write_header() {
  const char* const found = CPLFindFile("gdal", "header.dxf");
  if (!found) return error("GDAL's header.dxf is missing; install gdal-data");
  Result<std::string> header = read_file(found, max_header_bytes);
  if (!header) return header.errors();
  constexpr int metres = 6, metric = 1;
  if (!set_variable(*header, "$INSUNITS", metres) || !set_variable(*header, "$MEASUREMENT", metric))
    return error("{}: it has no $INSUNITS and $MEASUREMENT to set; is this GDAL's header?", found);
  VSILFILE* const file = VSIFOpenL(header_in_memory, "wb");
  const bool is_written =
      file && VSIFWriteL(header->data(), 1, header->size(), file) == header->size() && VSIFCloseL(file) == 0;
  return is_written ? Status(Ok{}) : Status(error("there is no memory for the drawing's header"));
}

std::string pen(glm::u8vec3 colour) {
  return fmt::format("PEN(c:#{:02x}{:02x}{:02x})", colour.x, colour.y, colour.z);
}

/// A feature of a layer under construction.
class Feature {
 public:
  explicit Feature(OGRLayerH layer) : layer_(layer), feature_(OGR_F_Create(OGR_L_GetLayerDefn(layer))) {}
  ~Feature() { OGR_F_Destroy(feature_); }
  Feature(const Feature&) = delete;
  Feature& operator=(const Feature&) = delete;

  void set(const char* field, const std::string& value) {
    OGR_F_SetFieldString(feature_, OGR_F_GetFieldIndex(feature_, field), value.c_str());
  }
  void set(const char* field, double value) {
    OGR_F_SetFieldDouble(feature_, OGR_F_GetFieldIndex(feature_, field), value);
  }
  void set(const char* field, const glm::dvec3& value) {
    OGR_F_SetFieldDoubleList(feature_, OGR_F_GetFieldIndex(feature_, field), 3, &value.x);
  }
  void style(const std::string& style) { OGR_F_SetStyleString(feature_, style.c_str()); }
  void line(const std::vector<glm::dvec3>& points) {
    const OGRGeometryH geometry = OGR_G_CreateGeometry(wkbLineString25D);
    for (const glm::dvec3& point : points) OGR_G_AddPoint(geometry, point.x, point.y, point.z);
    OGR_F_SetGeometryDirectly(feature_, geometry);
  }
  void point(const glm::dvec3& place) {
    const OGRGeometryH geometry = OGR_G_CreateGeometry(wkbPoint25D);
    OGR_G_SetPoint(geometry, 0, place.x, place.y, place.z);
    OGR_F_SetGeometryDirectly(feature_, geometry);
  }
  bool add() { return OGR_L_CreateFeature(layer_, feature_) == OGRERR_NONE; }

 private:
  OGRLayerH layer_;
  OGRFeatureH feature_;
};

bool add_blocks(OGRLayerH layer, const DxfPlan& plan) {
  for (const DxfBlock& block : plan.blocks)
    for (const std::vector<glm::dvec3>& points : block.lines) {
      Feature feature(layer);
      feature.set("Block", dxf_name(block.name)), feature.set("Layer", "0");
      feature.line(points);
      if (!feature.add()) return false;
    }
  return true;
}

bool add_entities(OGRLayerH layer, const DxfPlan& plan) {
  for (const DxfLine& line : plan.lines) {
    if (line.points.size() < 2) continue;
    Feature feature(layer);
    feature.set("Layer", dxf_name(line.layer)), feature.style(pen(line.colour)), feature.line(line.points);
    if (!feature.add()) return false;
  }
  for (const DxfInsert& insert : plan.inserts) {
    Feature feature(layer);
    feature.set("Layer", dxf_name(insert.layer)), feature.set("BlockName", dxf_name(insert.block));
    feature.set("BlockScale", insert.size_m), feature.set("BlockAngle", insert.angle_deg);
    feature.style(pen(insert.colour)), feature.point(insert.position);
    if (!feature.add()) return false;
  }
  for (const DxfText& text : plan.texts) {
    Feature feature(layer);
    std::string quoted;
    for (const char c : text.text) quoted += c == '"' ? "\\\"" : std::string(1, c);
    feature.set("Layer", dxf_name(text.layer));
    feature.style(fmt::format("LABEL(f:\"Arial\",t:\"{}\",s:{}g,p:1,c:#000000)", quoted, text.height_m));
    feature.point(text.position);
    if (!feature.add()) return false;
  }
  return true;
}

Status write_in_memory(const DxfPlan& plan) {
  const GDALDriverH driver = GDALGetDriverByName("DXF");
  const std::string header = std::string("HEADER=") + header_in_memory;
  const char* options[]{header.c_str(), nullptr};
  const GDALDatasetH dataset =
      driver ? GDALCreate(driver, plan_in_memory, 0, 0, 0, GDT_Unknown, const_cast<char**>(options))
             : nullptr;
  if (!dataset) return error("GDAL cannot write DXF ({})", CPLGetLastErrorMsg());
  const OGRLayerH blocks = GDALDatasetCreateLayer(dataset, "blocks", nullptr, wkbUnknown, nullptr);
  const OGRLayerH entities = GDALDatasetCreateLayer(dataset, "entities", nullptr, wkbUnknown, nullptr);
  const bool is_complete = blocks && entities && add_blocks(blocks, plan) && add_entities(entities, plan);
  GDALClose(dataset);
  if (!is_complete || CPLGetLastErrorType() == CE_Failure)
    return error("GDAL could not write all of the drawing ({})", CPLGetLastErrorMsg());
  return Ok{};
}

}  // namespace

Result<std::string> dxf_by_gdal(const DxfPlan& plan) {
  static const bool is_ready = (GDALAllRegister(), true);
  static_cast<void>(is_ready);
  const GdalInMemory quiet;
  if (Status status = write_header(); !status) return status.errors();
  if (Status status = write_in_memory(plan); !status) return status.errors();
  vsi_l_offset size = 0;
  const GByte* const bytes = VSIGetMemFileBuffer(plan_in_memory, &size, FALSE);
  if (!bytes) return error("GDAL wrote nothing");
  return std::string(reinterpret_cast<const char*>(bytes), std::size_t(size));
}

}  // namespace parvis::formats
