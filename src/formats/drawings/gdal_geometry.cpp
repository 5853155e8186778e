#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>
#include <gdal.h>
#include <ogr_api.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "formats/drawings/dxf_module.h"

namespace parvis::formats {
namespace {

constexpr double farthest_m = 1e9;  // what lies beyond is a fault: the earth is not so large
constexpr const char* memory_file = "/vsimem/parvis_drawing.dxf";

/// Half of `max_chord_gap_m`; the other half is what points are left out for.
constexpr double arc_gap_m = 0.5 * max_chord_gap_m;

/// A setting of GDAL for as long as it lives.
class Setting {
 public:
  Setting(const char* name, const std::string& value) : name_(name) {
    CPLSetThreadLocalConfigOption(name, value.c_str());
  }
  ~Setting() { CPLSetThreadLocalConfigOption(name_, nullptr); }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  const char* name_;
};

/// GDAL's messages go nowhere: what it did not draw is counted by handles.
struct QuietGdal {
  QuietGdal() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

/// A feature's style, in ground units.
struct Style {
  glm::u8vec3 colour{0};
  bool is_filled = false;
  double text_height = 0.0, angle_deg = 0.0;
  glm::dvec2 anchor{0.0};
};

/// GDAL's anchors: 1 to 3 at the base line, then the middle, the top and the bottom, each left, middle,
/// right.
glm::dvec2 anchor_of(int number) {
  if (number < 1 || number > 12) return glm::dvec2(0.0);
  static constexpr double heights[]{0.0, 0.5, 1.0, 0.0};
  return {0.5 * ((number - 1) % 3), heights[(number - 1) / 3]};
}

glm::u8vec3 colour_of(const char* text) {
  glm::u8vec3 colour(0);
  const std::string_view written = text ? text : "";
  for (int i = 0; i < 3 && written.size() >= std::size_t(3 + 2 * i); ++i) {
    const char* const digits = written.data() + 1 + 2 * i;
    std::from_chars(digits, digits + 2, colour[i], 16);
  }
  return colour;
}

Style style_of(OGRFeatureH feature) {
  Style style;
  const OGRStyleMgrH manager = OGR_SM_Create(nullptr);
  OGR_SM_InitFromFeature(manager, feature);
  for (int i = 0; i < OGR_SM_GetPartCount(manager, nullptr); ++i) {
    const OGRStyleToolH tool = OGR_SM_GetPart(manager, i, nullptr);
    if (!tool) continue;
    OGR_ST_SetUnit(tool, OGRSTUGround, 1.0);
    int is_default = 0;
    const OGRSTClassId kind = OGR_ST_GetType(tool);
    const int colour = kind == OGRSTCBrush ? int(OGRSTBrushFColor)
                       : kind == OGRSTCPen ? int(OGRSTPenColor)
                                           : int(OGRSTLabelFColor);
    style.colour = colour_of(OGR_ST_GetParamStr(tool, colour, &is_default));
    style.is_filled = style.is_filled || kind == OGRSTCBrush;
    if (kind == OGRSTCLabel) {
      style.text_height = OGR_ST_GetParamDbl(tool, OGRSTLabelSize, &is_default);
      style.angle_deg = OGR_ST_GetParamDbl(tool, OGRSTLabelAngle, &is_default);
      if (is_default) style.angle_deg = 0.0;
      style.anchor = anchor_of(OGR_ST_GetParamNum(tool, OGRSTLabelAnchor, &is_default));
    }
    OGR_ST_Destroy(tool);
  }
  OGR_SM_Destroy(manager);
  return style;
}

/// Leaves out points of a polyline that lie within `gap` of what remains (Douglas and Peucker 1973), without
/// recursion: a spiral would exhaust the stack.
void simplify(std::vector<glm::dvec3>& points, double gap) {
  if (points.size() < 3) return;
  std::vector<bool> stays(points.size(), false);
  stays.front() = stays.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [first, last] = open.back();
    open.pop_back();
    const glm::dvec3 chord = points[last] - points[first];
    const double length2 = glm::dot(chord, chord);
    double farthest = gap;
    std::size_t at = 0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const glm::dvec3 from = points[i] - points[first];
      const double along = length2 > 0.0 ? std::clamp(glm::dot(from, chord) / length2, 0.0, 1.0) : 0.0;
      const double distance = glm::length(from - along * chord);
      if (distance > farthest) farthest = distance, at = i;
    }
    if (at == 0) continue;
    stays[at] = true;
    open.emplace_back(first, at), open.emplace_back(at, last);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (stays[i]) points[kept++] = points[i];
  points.resize(kept);
}

/// Takes features over into a drawing.
class Collector {
 public:
  Collector(const DrawingFacts& facts, Drawing& drawing) : drawing_(drawing) {
    for (std::size_t i = 0; i < drawing.layers.size(); ++i) layer_of_[drawing.layers[i].name] = int(i);
    for (const DrawingEntity& entity : facts.entities) {
      if (entity.width > 0.0 && !entity.handle.empty())
        width_m_of_[entity.handle] = entity.width * drawing.metres_per_unit;
      result_.has_handles = result_.has_handles || !entity.handle.empty();
    }
    drawing_.min = glm::dvec3(farthest_m), drawing_.max = glm::dvec3(-farthest_m);
  }

  void add(OGRFeatureH feature) {
    if (integer(feature, "PaperSpace") == 1) return;
    const OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    if (!geometry) return;
    const std::string handle = text(feature, "EntityHandle");
    const Style style = style_of(feature);
    const int layer = layer_index(text(feature, "Layer"));
    const std::size_t before = count(), lines_before = drawing_.lines.size();
    add_geometry(geometry, feature, layer, style, handle);
    if (count() == before) return;
    std::vector<std::size_t>& lines = result_.lines_of[handle];
    for (std::size_t i = lines_before; i < drawing_.lines.size(); ++i) lines.push_back(i);
  }

  DrawingGeometry result() {
    if (drawing_.min.x > drawing_.max.x) drawing_.min = drawing_.max = glm::dvec3(0.0);
    return std::move(result_);
  }

 private:
  std::size_t count() const {
    return drawing_.lines.size() + drawing_.areas.size() + drawing_.texts.size() + drawing_.points.size();
  }

  static std::string text(OGRFeatureH feature, const char* field) {
    const int index = OGR_F_GetFieldIndex(feature, field);
    const char* const value = index < 0 ? nullptr : OGR_F_GetFieldAsString(feature, index);
    return value ? value : "";
  }
  static int integer(OGRFeatureH feature, const char* field) {
    const int index = OGR_F_GetFieldIndex(feature, field);
    return index < 0 ? 0 : OGR_F_GetFieldAsInteger(feature, index);
  }

  int layer_index(const std::string& name) {
    const auto [found, is_new] = layer_of_.try_emplace(name, int(drawing_.layers.size()));
    if (is_new) drawing_.layers.push_back({.name = name});
    return found->second;
  }

  /// The points in metres; nothing, and counted, where one lies beyond the earth.
  std::optional<std::vector<glm::dvec3>> points_of(OGRGeometryH geometry) {
    std::vector<glm::dvec3> points(std::size_t(OGR_G_GetPointCount(geometry)));
    for (std::size_t i = 0; i < points.size(); ++i) {
      glm::dvec3& point = points[i];
      OGR_G_GetPoint(geometry, int(i), &point.x, &point.y, &point.z);
      point *= drawing_.metres_per_unit;
      if (!(glm::length(point) < farthest_m)) {
        ++result_.far_away;
        return std::nullopt;
      }
    }
    for (const glm::dvec3& point : points)
      drawing_.min = glm::min(drawing_.min, point), drawing_.max = glm::max(drawing_.max, point);
    return points;
  }

  void add_line(OGRGeometryH geometry, int layer, const Style& style, const std::string& handle) {
    std::optional<std::vector<glm::dvec3>> points = points_of(geometry);
    if (!points || points->size() < 2) return;
    simplify(*points, arc_gap_m);
    const auto width = width_m_of_.find(handle);
    drawing_.lines.push_back(
        {layer, style.colour, width == width_m_of_.end() ? 0.0 : width->second, *std::move(points)});
  }

  void add_area(OGRGeometryH polygon, OGRFeatureH feature, int layer, const Style& style,
                const std::string& handle) {
    if (!style.is_filled) {
      for (int i = 0; i < OGR_G_GetGeometryCount(polygon); ++i)
        add_line(OGR_G_GetGeometryRef(polygon, i), layer, style, handle);
      return;
    }
    const std::string pattern = text(feature, "Text");  // where GDAL keeps the pattern's name
    DrawingArea area{layer, style.colour, pattern.empty() || pattern == "SOLID", {}};
    for (int i = 0; i < OGR_G_GetGeometryCount(polygon); ++i) {
      std::optional<std::vector<glm::dvec3>> ring = points_of(OGR_G_GetGeometryRef(polygon, i));
      if (!ring) return;
      simplify(*ring, arc_gap_m);
      if (ring->size() > 1 && glm::distance(ring->front(), ring->back()) < 1e-9) ring->pop_back();
      if (ring->size() >= 3) area.rings.push_back(*std::move(ring));
    }
    if (!area.rings.empty()) drawing_.areas.push_back(std::move(area));
  }

  void add_point(OGRGeometryH geometry, OGRFeatureH feature, int layer, const Style& style) {
    const std::optional<std::vector<glm::dvec3>> points = points_of(geometry);
    if (!points || points->empty()) return;
    const std::string words = text(feature, "Text");
    if (words.empty()) {
      drawing_.points.push_back({layer, points->front()});
    } else {
      drawing_.texts.push_back({layer, style.colour, words, points->front(),
                                style.text_height * drawing_.metres_per_unit, style.angle_deg, style.anchor});
    }
  }

  void add_geometry(OGRGeometryH geometry, OGRFeatureH feature, int layer, const Style& style,
                    const std::string& handle) {
    switch (wkbFlatten(OGR_G_GetGeometryType(geometry))) {
      case wkbPoint:
        return add_point(geometry, feature, layer, style);
      case wkbLineString:
        return add_line(geometry, layer, style, handle);
      case wkbPolygon:
      case wkbTriangle:
        return add_area(geometry, feature, layer, style, handle);
      default:
        for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
          add_geometry(OGR_G_GetGeometryRef(geometry, i), feature, layer, style, handle);
    }
  }

  Drawing& drawing_;
  DrawingGeometry result_;
  std::unordered_map<std::string, int> layer_of_;
  std::unordered_map<std::string, double> width_m_of_;
};

}  // namespace

Result<DrawingGeometry> geometry_by_gdal(const std::string& dxf_text, const DrawingFacts& facts,
                                         const std::string& file, Drawing& drawing) {
  static const bool is_ready = (GDALAllRegister(), true);
  static_cast<void>(is_ready);
  const QuietGdal quiet;
  const Setting encoding("DXF_ENCODING", "UTF-8");              // decode_texts has made it so
  const Setting blocks("DXF_MERGE_BLOCK_GEOMETRIES", "FALSE");  // their parts have layers of their own
  const Setting step("OGR_ARC_STEPSIZE", "0.5");
  // A chord of 1 m lies half a millimetre from an arc of 250 m, up to which the step is enough.
  const Setting gap("OGR_ARC_MAX_GAP", fmt::format("{}", 1.0 / drawing.metres_per_unit));
  std::string bytes = dxf_text;
  const std::unique_ptr<VSILFILE, int (*)(VSILFILE*)> in_memory(
      VSIFileFromMemBuffer(memory_file, reinterpret_cast<GByte*>(bytes.data()), bytes.size(), FALSE),
      VSIFCloseL);
  const char* const formats[]{"DXF", nullptr};
  const std::unique_ptr<void, void (*)(GDALDatasetH)> dataset{
      GDALOpenEx(memory_file, GDAL_OF_VECTOR | GDAL_OF_READONLY, formats, nullptr, nullptr),
      [](GDALDatasetH opened) {
        if (opened) GDALClose(opened);
        VSIUnlink(memory_file);
      }};
  if (!dataset)
    return error_at({file, 0, 0}, "this DXF cannot be read ({}); save it again as DXF 2000 or later",
                    CPLGetLastErrorMsg());
  Collector collector(facts, drawing);
  const OGRLayerH entities = GDALDatasetGetLayer(dataset.get(), 0);
  while (const OGRFeatureH feature = entities ? OGR_L_GetNextFeature(entities) : nullptr) {
    collector.add(feature);
    OGR_F_Destroy(feature);
  }
  return collector.result();
}

}  // namespace parvis::formats
