#include "formats/city_models/city_gml.h"

#include <citygml/citygml.h>
#include <citygml/citygmllogger.h>
#include <citygml/citymodel.h>
#include <citygml/geometry.h>
#include <citygml/implictgeometry.h>
#include <citygml/linearring.h>
#include <citygml/material.h>
#include <citygml/polygon.h>
#include <citygml/texture.h>
#include <citygml/texturecoordinates.h>
#include <citygml/texturetargetdefinition.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

#include "base/exception_reason.h"
#include "formats/city_models/building_attributes.h"
#include "formats/city_models/city_assembly.h"
#include "formats/city_models/city_gml_3.h"
#include "formats/city_models/city_lod.h"
#include "formats/city_models/city_solid.h"
#include "formats/city_models/xml_guard.h"
#include "formats/terrain/city_surfaces.h"

namespace parvis::scene {
namespace {

using Kind = citygml::CityObject::CityObjectsType;

// The library's logger has a destructor that is not virtual; shared_ptr knows the type that it deletes.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
/// Keeps what libcitygml complains about, which it would write to the terminal.
class Complaints final : public citygml::CityGMLLogger {
 public:
  void log(LOGLEVEL, const std::string& message, const char*, int) const override {
    if (first_.empty()) first_ = message;
  }
  const std::string& first() const { return first_; }

 private:
  mutable std::string first_;
};
#pragma GCC diagnostic pop

/// Surfaces that bound an object, rather than being one.
bool is_boundary(Kind kind) {
  switch (kind) {
    case Kind::COT_WallSurface:
    case Kind::COT_RoofSurface:
    case Kind::COT_GroundSurface:
    case Kind::COT_ClosureSurface:
    case Kind::COT_FloorSurface:
    case Kind::COT_InteriorWallSurface:
    case Kind::COT_CeilingSurface:
    case Kind::COT_OuterCeilingSurface:
    case Kind::COT_OuterFloorSurface:
    case Kind::COT_Door:
    case Kind::COT_Window:
    case Kind::COT_TransportationObject:
      return true;
    default:
      return false;
  }
}

/// CityJSON's name of a type.
std::string type_name(const citygml::CityObject& object) {
  switch (object.getType()) {
    case Kind::COT_Square:
      return "TransportSquare";
    case Kind::COT_Track:
      return "Road";
    case Kind::COT_ReliefFeature:
    case Kind::COT_ReliefComponent:
    case Kind::COT_TINRelief:
    case Kind::COT_MassPointRelief:
    case Kind::COT_BreaklineRelief:
    case Kind::COT_RasterRelief:
      return "TINRelief";
    default:
      return object.getTypeAsString();
  }
}

std::string semantics_of(const citygml::Geometry& geometry, const std::string& of_object) {
  using Type = citygml::Geometry::GeometryType;
  switch (geometry.getType()) {
    case Type::GT_Roof:
      return "RoofSurface";
    case Type::GT_Wall:
      return "WallSurface";
    case Type::GT_Ground:
      return "GroundSurface";
    case Type::GT_OuterCeiling:
      return "OuterCeilingSurface";
    case Type::GT_OuterFloor:
      return "OuterFloorSurface";
    case Type::GT_InteriorWall:
      return "InteriorWallSurface";
    case Type::GT_Ceiling:
      return "CeilingSurface";
    case Type::GT_Floor:
      return "FloorSurface";
    default:
      return of_object;
  }
}

glm::dvec3 vec(const TVec3d& v) { return {v.x, v.y, v.z}; }
glm::vec3 vec(const TVec3f& v) { return {v.x, v.y, v.z}; }

/// A geometry among those of an object and of the surfaces that bound it.
struct Shown {
  const citygml::Geometry* geometry;
  std::string semantics;
  glm::dmat4 file_from_geometry{1.0};
};

/// Calls use(geometry, matrix) for the object's own geometries and its placed templates.
template <class Use>
void each_geometry(const citygml::CityObject& object, const Use& use) {
  for (unsigned i = 0; i < object.getGeometriesCount(); ++i) use(object.getGeometry(i), glm::dmat4(1.0));
  for (unsigned i = 0; i < object.getImplicitGeometryCount(); ++i) {
    const citygml::ImplicitGeometry& placed = object.getImplicitGeometry(i);
    glm::dmat4 matrix(1.0);
    for (int k = 0; k < 16; ++k)  // row after row
      matrix[k % 4][k / 4] = placed.getTransformMatrix().getMatrix()[k];
    matrix[3] += glm::dvec4(vec(placed.getReferencePoint()), 0.0);
    for (unsigned k = 0; k < placed.getGeometriesCount(); ++k) use(placed.getGeometry(k), matrix);
  }
}

void gather(const citygml::CityObject& object, std::vector<Shown>& shown) {
  const std::string semantics = is_boundary(object.getType()) ? object.getTypeAsString() : "";
  each_geometry(object, [&](const citygml::Geometry& geometry, const glm::dmat4& matrix) {
    shown.push_back({&geometry, semantics_of(geometry, semantics), matrix});
  });
  for (unsigned i = 0; i < object.getChildCityObjectsCount(); ++i)
    if (is_boundary(object.getChildCityObject(i).getType())) gather(object.getChildCityObject(i), shown);
}

bool has_polygons(const citygml::Geometry& geometry) {
  if (geometry.getPolygonsCount() > 0) return true;
  for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i)
    if (has_polygons(geometry.getGeometry(i))) return true;
  return false;
}

class Reader {
 public:
  Reader(const std::filesystem::path& file, const citygml::CityModel& model, Errors& warnings,
         std::optional<double> max_detail)
      : model_(model), max_detail_(max_detail), city_(file, origin(model), warnings) {
    if (const auto themes = model.themes(); !themes.empty()) theme_ = themes.front();
  }

  Result<Model> read() {
    for (const citygml::CityObject* object : model_.getRootCityObjects()) read_object(*object);
    return city_.finish(object_count_);
  }

 private:
  static glm::dvec3 origin(const citygml::CityModel& model) {
    glm::dvec3 low(1e300), high(-1e300);
    for (const citygml::CityObject* object : model.getRootCityObjects()) widen(*object, low, high);
    if (low.x > high.x) return glm::dvec3(0.0);
    return {std::round(0.5 * (low.x + high.x)), std::round(0.5 * (low.y + high.y)), 0.0};
  }

  static void widen(const citygml::CityObject& object, glm::dvec3& low, glm::dvec3& high) {
    each_geometry(object, [&](const citygml::Geometry& geometry, const glm::dmat4& matrix) {
      widen(geometry, matrix, low, high);
    });
    for (unsigned i = 0; i < object.getChildCityObjectsCount(); ++i)
      widen(object.getChildCityObject(i), low, high);
  }

  static void widen(const citygml::Geometry& geometry, const glm::dmat4& matrix, glm::dvec3& low,
                    glm::dvec3& high) {
    for (unsigned i = 0; i < geometry.getPolygonsCount(); ++i)
      for (const TVec3d& point : points_of(geometry.getPolygon(i)->exteriorRing())) {
        const glm::dvec3 placed(matrix * glm::dvec4(vec(point), 1.0));
        if (!std::isfinite(placed.x + placed.y)) continue;
        low = glm::min(low, placed), high = glm::max(high, placed);
      }
    for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i)
      widen(geometry.getGeometry(i), matrix, low, high);
  }

  /// `whole`: of the building that the object is a part of.
  void read_object(const citygml::CityObject& object, const BuildingKind& whole = {}) {
    ++object_count_;
    std::vector<Shown> all;
    gather(object, all);
    std::erase_if(all, [](const Shown& shown) { return !has_polygons(*shown.geometry); });
    std::vector<double> levels;
    levels.reserve(all.size());
    for (const Shown& shown : all) levels.push_back(shown.geometry->getLOD());
    const BuildingKind kind = kind_of(object, whole);
    object_ = {object.getId(), type_name(object), object.getAttribute("function"), kind};
    const auto wanted = wanted_level(levels, max_detail_);
    // A solid lists the surfaces that bound it a second time: those that have a name count, and come first.
    seen_.clear();
    for (const bool is_named : {true, false})
      for (const Shown& shown : all)
        if (shown.semantics.empty() != is_named && double(shown.geometry->getLOD()) == wanted)
          read_geometry(*shown.geometry, shown.semantics, shown.file_from_geometry);
    add_surfaces();
    for (unsigned i = 0; i < object.getChildCityObjectsCount(); ++i)
      if (!is_boundary(object.getChildCityObject(i).getType()))
        read_object(object.getChildCityObject(i), kind);
  }

  static BuildingKind kind_of(const citygml::CityObject& object, const BuildingKind& whole) {
    if (!is_building(type_name(object))) return {};
    BuildingAttributes attributes;
    for (const auto& [name, value] : object.getAttributes()) attributes.emplace(name, value.asString());
    return completed(kind_of_building(attributes), whole);
  }

  void read_geometry(const citygml::Geometry& geometry, const std::string& semantics,
                     const glm::dmat4& matrix) {
    for (unsigned i = 0; i < geometry.getPolygonsCount(); ++i)
      read_polygon(*geometry.getPolygon(i), semantics_of(geometry, semantics), matrix);
    for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i)
      read_geometry(geometry.getGeometry(i), semantics_of(geometry.getGeometry(i), semantics), matrix);
  }

  void read_polygon(const citygml::Polygon& polygon, const std::string& semantics, const glm::dmat4& matrix) {
    if (!seen_.insert(&polygon).second) return;
    CitySurface surface;
    surface.semantics = semantics;
    const auto texture = polygon.getTextureFor(theme_);
    if (texture) surface.picture = picture_of(*texture);
    if (const auto material = polygon.getMaterialFor(theme_)) surface.material = material_of(*material);
    read_ring(polygon, polygon.exteriorRing(), matrix, surface);
    for (const auto& hole : polygon.interiorRings()) read_ring(polygon, hole, matrix, surface);
    surfaces_.push_back(std::move(surface));
  }

  void add_surfaces() {
    const bool is_solid = bound_a_solid(surfaces_);
    for (CitySurface& surface : surfaces_) {
      surface.is_of_solid = is_solid;
      city_.add(object_, surface);
    }
    surfaces_.clear();
  }

  /// Without the closing point, which repeats the first.
  void read_ring(const citygml::Polygon& polygon, const std::shared_ptr<citygml::LinearRing>& ring,
                 const glm::dmat4& matrix, CitySurface& surface) const {
    const std::vector<TVec3d>& corners = points_of(ring);
    const std::vector<glm::vec2> uvs = coordinates_of(polygon, ring);
    const bool is_mirrored = glm::determinant(glm::dmat3(matrix)) < 0.0;
    std::vector<glm::dvec3> points;
    std::vector<glm::vec2> points_uvs;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::size_t i = is_mirrored ? corners.size() - 1 - k : k;
      const glm::dvec3 point(matrix * glm::dvec4(vec(corners[i]), 1.0));
      if (!points.empty() && (point == points.back() || (k + 1 == corners.size() && point == points.front())))
        continue;
      points.push_back(point);
      if (uvs.size() == corners.size()) points_uvs.push_back(uvs[i]);
    }
    if (points.size() < 3) return;
    surface.rings.push_back(std::move(points));
    surface.picture_uv.insert(surface.picture_uv.end(), points_uvs.begin(), points_uvs.end());
  }

  static const std::vector<TVec3d>& points_of(const std::shared_ptr<citygml::LinearRing>& ring) {
    static const std::vector<TVec3d> none;
    return ring ? ring->getVertices() : none;
  }

  std::vector<glm::vec2> coordinates_of(const citygml::Polygon& polygon,
                                        const std::shared_ptr<citygml::LinearRing>& ring) const {
    const auto definition = polygon.getTextureTargetDefinitionForTheme(theme_, true);
    std::vector<glm::vec2> uvs;
    for (unsigned i = 0; definition && i < definition->getTextureCoordinatesCount(); ++i)
      if (const auto list = definition->getTextureCoordinates(i); list->targets(*ring))
        for (const TVec2f& uv : list->getCoords()) uvs.emplace_back(uv.x, 1.0f - uv.y);  // ours run downward
    return uvs;
  }

  int picture_of(const citygml::Texture& texture) {
    const auto [known, is_new] = pictures_.try_emplace(texture.getUrl(), no_index);
    using Wrap = citygml::Texture::WrapMode;
    const bool repeats = texture.getWrapMode() == Wrap::WM_WRAP || texture.getWrapMode() == Wrap::WM_MIRROR ||
                         texture.getRepeat();
    if (is_new) known->second = city_.add_picture(texture.getUrl(), repeats);
    return known->second;
  }

  int material_of(const citygml::Material& m) {
    return city_.add_material({.diffuse = vec(m.getDiffuse()),
                               .emissive = vec(m.getEmissive()),
                               .transparency = m.getTransparency(),
                               .shininess = m.getShininess()});
  }

  const citygml::CityModel& model_;
  std::optional<double> max_detail_;
  CityAssembly city_;
  std::string theme_;
  std::size_t object_count_ = 0;
  CityObject object_;                       ///< that is being read
  std::vector<CitySurface> surfaces_;       ///< of it
  std::set<const citygml::Polygon*> seen_;  ///< of it
  std::map<std::string, int> pictures_;
};

/// The text of a file in the elements of CityGML 1 or 2.
Result<std::string> read_gml_2(const std::filesystem::path& file) {
  const FileLocation where{file.string(), 0, 0};
  Result<XmlText> xml = read_xml(file);
  if (!xml) return xml.errors();
  if (xml->root.find("CityModel") == std::string::npos)
    return error_at(where, "this is no CityGML: its outermost element is <{}>; expected <CityModel>",
                    xml->root.substr(0, xml->root.find(' ')));
  if (is_city_gml_3(xml->root)) return city_gml_2_of(xml->bytes, where);
  return std::move(xml->bytes);
}

}  // namespace

Result<Model> read_city_gml(const std::filesystem::path& file, Errors& warnings,
                            std::optional<double> max_detail) {
  const FileLocation where{file.string(), 0, 0};
  Result<std::string> text = read_gml_2(file);
  if (!text) return text.errors();
  const auto complaints = std::make_shared<Complaints>();
  citygml::ParserParams wanted;
  wanted.tesselate = false;  // rings are kept as they are; the assembly makes triangles
  wanted.keepVertices = true;
  try {
    std::istringstream stream(*std::move(text));
    const auto city = citygml::load(stream, wanted, complaints);
    if (!city) return error_at(where, "libcitygml cannot read it ({})", complaints->first());
    return Reader(file, *city, warnings, max_detail).read();
  } catch (const std::exception& problem) {
    return error_at(where, "libcitygml cannot read it ({})", reason_of(problem));
  } catch (...) {  // Xerces throws what is no std::exception
    return error_at(where, "libcitygml cannot read it ({})", complaints->first());
  }
}

}  // namespace parvis::scene
