#include "formats/city_models/citygml_module.h"

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
#include <functional>
#include <map>
#include <set>
#include <sstream>
#include <unordered_map>

#include "base/exception_reason.h"
#include "formats/city_models/building_attributes.h"
#include "formats/city_models/city_assembly.h"
#include "formats/city_models/city_coordinates.h"
#include "formats/city_models/city_gml_3.h"
#include "formats/city_models/city_gml_extensions.h"
#include "formats/city_models/city_lod.h"
#include "formats/city_models/city_solid.h"
#include "formats/city_models/georeferenced_textures.h"
#include "formats/city_models/gml_geometry.h"
#include "formats/city_models/xml_guard.h"
#include "formats/terrain/map_system.h"
#include "land/heights/city_surfaces.h"

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

std::string semantics_of_geometry(const citygml::Geometry& geometry, const std::string& of_object) {
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

/// Where a geometry's points lie: in the file's coordinates, or, of a template, in metres about a point of
/// these.
struct Placement {
  bool is_template = false;
  glm::dmat4 metres_from_template{1.0};
  glm::dvec3 reference{0.0};  ///< of a template, in the file's coordinates
};

/// A geometry among those of an object and of the surfaces that bound it.
struct Shown {
  const citygml::Geometry* geometry;
  std::string semantics;
  Placement placement{};
};

/// Calls use(geometry, placement) for the object's own geometries and its placed templates.
template <class Use>
void each_geometry(const citygml::CityObject& object, const Use& use) {
  for (unsigned i = 0; i < object.getGeometriesCount(); ++i) use(object.getGeometry(i), Placement{});
  for (unsigned i = 0; i < object.getImplicitGeometryCount(); ++i) {
    const citygml::ImplicitGeometry& placed = object.getImplicitGeometry(i);
    Placement placement{.is_template = true, .reference = vec(placed.getReferencePoint())};
    for (int k = 0; k < 16; ++k)  // row after row
      placement.metres_from_template[k % 4][k / 4] = placed.getTransformMatrix().getMatrix()[k];
    for (unsigned k = 0; k < placed.getGeometriesCount(); ++k) use(placed.getGeometry(k), placement);
  }
}

void gather(const citygml::CityObject& object, std::vector<Shown>& shown) {
  const std::string semantics = is_boundary(object.getType()) ? object.getTypeAsString() : "";
  each_geometry(object, [&](const citygml::Geometry& geometry, const Placement& placement) {
    shown.push_back({&geometry, semantics_of_geometry(geometry, semantics), placement});
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

const std::vector<TVec3d>& points_of(const std::shared_ptr<citygml::LinearRing>& ring) {
  static const std::vector<TVec3d> none;
  return ring ? ring->getVertices() : none;
}

/// Collects properties of a file's coordinates.
class Clues {
 public:
  Clues(const citygml::CityModel& model, const std::string& system) {
    clues_.system = system;
    for (const citygml::CityObject* object : model.getRootCityObjects()) add(*object);
  }
  const CoordinateClues& get() const { return clues_; }

 private:
  void add(const citygml::CityObject& object) {
    const bool is_roof = object.getType() == Kind::COT_RoofSurface;
    each_geometry(object, [&](const citygml::Geometry& geometry, const Placement& placement) {
      if (placement.is_template)
        clues_.add(placement.reference);
      else
        add_whole(geometry, is_roof);
    });
    for (unsigned i = 0; i < object.getChildCityObjectsCount(); ++i) add(object.getChildCityObject(i));
  }

  /// Adds all surfaces as one body where none has a name.
  void add_whole(const citygml::Geometry& geometry, bool is_roof) {
    rings_.clear(), has_names_ = is_roof;
    add(geometry, is_roof);
    if (!has_names_) clues_.add_body(rings_);
  }

  void add(const citygml::Geometry& geometry, bool is_roof) {
    has_names_ = has_names_ || geometry.getType() != citygml::Geometry::GeometryType::GT_Unknown;
    is_roof = is_roof || geometry.getType() == citygml::Geometry::GeometryType::GT_Roof;
    for (unsigned i = 0; i < geometry.getPolygonsCount(); ++i) {
      std::vector<glm::dvec3> ring;
      for (const TVec3d& point : points_of(geometry.getPolygon(i)->exteriorRing())) {
        ring.push_back(vec(point));
        clues_.add(ring.back());
      }
      if (is_roof) clues_.add_roof(ring);
      rings_.push_back(std::move(ring));
      for (const auto& hole : geometry.getPolygon(i)->interiorRings()) {
        std::vector<glm::dvec3>& inner = rings_.emplace_back();
        for (const TVec3d& point : points_of(hole)) inner.push_back(vec(point));
      }
    }
    for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i) add(geometry.getGeometry(i), is_roof);
  }

  CoordinateClues clues_;
  std::vector<std::vector<glm::dvec3>> rings_;  ///< of one geometry
  bool has_names_ = false;
};

class CityGmlReader {
 public:
  CityGmlReader(const std::filesystem::path& file, const citygml::CityModel& model,
                CityCoordinates coordinates, std::vector<GeoreferencedTexture> draped, Errors& warnings,
                std::optional<double> max_detail)
      : model_(model),
        coordinates_(std::move(coordinates)),
        draped_(std::move(draped)),
        max_detail_(max_detail),
        file_(file),
        warnings_(warnings),
        city_(file, origin(), warnings) {
    for (const GeoreferencedTexture& texture : draped_)
      for (const std::string& target : texture.targets) draped_on_.emplace(target, &texture);
    if (const auto themes = model.themes(); !themes.empty()) theme_ = themes.front();
  }

  Result<Model> read() {
    for (const citygml::CityObject* object : model_.getRootCityObjects()) read_object(*object);
    beside_pictures_.report(file_, warnings_);
    Result<Model> model = city_.finish(object_count_);
    if (model) model->map = coordinates_.map(), model->true_north_deg = coordinates_.true_north_deg();
    return model;
  }

 private:
  glm::dvec3 origin() const {
    glm::dvec3 low(1e300), high(-1e300);
    for (const citygml::CityObject* object : model_.getRootCityObjects()) widen(*object, low, high);
    if (low.x > high.x) return glm::dvec3(0.0);
    return {std::round(0.5 * (low.x + high.x)), std::round(0.5 * (low.y + high.y)), 0.0};
  }

  /// The point in metres on the map.
  glm::dvec3 placed(const glm::dvec3& point, const Placement& placement) const {
    if (!placement.is_template) return coordinates_(point);
    return coordinates_(placement.reference) +
           glm::dvec3(placement.metres_from_template * glm::dvec4(point, 1.0));
  }

  void widen(const citygml::CityObject& object, glm::dvec3& low, glm::dvec3& high) const {
    each_geometry(object, [&](const citygml::Geometry& geometry, const Placement& placement) {
      widen(geometry, placement, low, high);
    });
    for (unsigned i = 0; i < object.getChildCityObjectsCount(); ++i)
      widen(object.getChildCityObject(i), low, high);
  }

  void widen(const citygml::Geometry& geometry, const Placement& placement, glm::dvec3& low,
             glm::dvec3& high) const {
    for (unsigned i = 0; i < geometry.getPolygonsCount(); ++i)
      for (const TVec3d& point : points_of(geometry.getPolygon(i)->exteriorRing())) {
        const glm::dvec3 there = placed(vec(point), placement);
        if (!std::isfinite(there.x + there.y)) continue;
        low = glm::min(low, there), high = glm::max(high, there);
      }
    for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i)
      widen(geometry.getGeometry(i), placement, low, high);
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
          read_geometry(*shown.geometry, shown.semantics, shown.placement, nullptr);
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

  /// The picture that lies on a geometry or polygon by its coordinates; `else_drape` where none names it.
  const GeoreferencedTexture* drape_of(const std::string& id, const GeoreferencedTexture* else_drape) const {
    const auto found = draped_on_.find(id);
    return found == draped_on_.end() ? else_drape : found->second;
  }

  void read_geometry(const citygml::Geometry& geometry, const std::string& semantics,
                     const Placement& placement, const GeoreferencedTexture* drape) {
    drape = drape_of(geometry.getId(), drape);
    for (unsigned i = 0; i < geometry.getPolygonsCount(); ++i)
      read_polygon(*geometry.getPolygon(i), semantics_of_geometry(geometry, semantics), placement, drape);
    for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i)
      read_geometry(geometry.getGeometry(i), semantics_of_geometry(geometry.getGeometry(i), semantics),
                    placement, drape);
  }

  void read_polygon(const citygml::Polygon& polygon, const std::string& semantics, const Placement& placement,
                    const GeoreferencedTexture* drape) {
    if (!seen_.insert(&polygon).second) return;
    CitySurface surface;
    surface.semantics = semantics;
    const auto texture = polygon.getTextureFor(theme_);
    if (texture) surface.picture = picture_of(*texture);
    if (const auto material = polygon.getMaterialFor(theme_)) surface.material = material_of(*material);
    // Texture coordinates of its own count first; the plan of a template is not that of the place.
    const bool has_own = !coordinates_of(polygon, polygon.exteriorRing()).empty();
    drape = has_own || placement.is_template ? nullptr : drape_of(polygon.getId(), drape);
    if (drape != nullptr) surface.picture = picture_of(drape->picture, false);
    const PlanToPicture* const lies = drape != nullptr ? &*drape->placed : nullptr;
    read_ring(polygon, polygon.exteriorRing(), placement, lies, surface);
    if (drape != nullptr) beside_pictures_.note(*drape, surface.picture_uv);
    for (const auto& hole : polygon.interiorRings()) read_ring(polygon, hole, placement, lies, surface);
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

  /// Reads a ring without the closing point, which repeats the first. `lies`: where on a picture; null: by
  /// the ring's own texture coordinates.
  void read_ring(const citygml::Polygon& polygon, const std::shared_ptr<citygml::LinearRing>& ring,
                 const Placement& placement, const PlanToPicture* lies, CitySurface& surface) const {
    const std::vector<TVec3d>& corners = points_of(ring);
    const std::vector<glm::vec2> uvs = coordinates_of(polygon, ring);
    const bool is_mirrored = glm::determinant(glm::dmat3(placement.metres_from_template)) < 0.0;
    std::vector<glm::dvec3> points;
    std::vector<glm::vec2> points_uvs;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::size_t i = is_mirrored ? corners.size() - 1 - k : k;
      const glm::dvec3 point = placed(vec(corners[i]), placement);
      if (!points.empty() && (point == points.back() || (k + 1 == corners.size() && point == points.front())))
        continue;
      points.push_back(point);
      if (lies != nullptr)
        points_uvs.push_back((*lies)(vec(corners[i])));
      else if (uvs.size() == corners.size())
        points_uvs.push_back(uvs[i]);
    }
    if (points.size() < 3) return;
    surface.rings.push_back(std::move(points));
    surface.picture_uv.insert(surface.picture_uv.end(), points_uvs.begin(), points_uvs.end());
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
    using Wrap = citygml::Texture::WrapMode;
    return picture_of(texture.getUrl(), texture.getWrapMode() == Wrap::WM_WRAP ||
                                            texture.getWrapMode() == Wrap::WM_MIRROR || texture.getRepeat());
  }
  int picture_of(const std::string& file, bool repeats) {
    const auto [known, is_new] = pictures_.try_emplace(file, no_index);
    if (is_new) known->second = city_.add_picture(file, repeats);
    return known->second;
  }

  int material_of(const citygml::Material& m) {
    return city_.add_material({.diffuse = vec(m.getDiffuse()),
                               .emissive = vec(m.getEmissive()),
                               .transparency = m.getTransparency(),
                               .shininess = m.getShininess()});
  }

  const citygml::CityModel& model_;
  CityCoordinates coordinates_;
  std::vector<GeoreferencedTexture> draped_;
  std::unordered_map<std::string, const GeoreferencedTexture*> draped_on_;  ///< by what they lie on
  BesidePictures beside_pictures_;
  std::optional<double> max_detail_;
  const std::filesystem::path& file_;
  Errors& warnings_;
  CityAssembly city_;
  std::string theme_;
  std::size_t object_count_ = 0;
  CityObject object_;                       ///< that is being read
  std::vector<CitySurface> surfaces_;       ///< of it
  std::set<const citygml::Polygon*> seen_;  ///< of it
  std::map<std::string, int> pictures_;
};

/// The different names of coordinate systems in a file, in its order; not more than a few.
std::vector<std::string> system_names(std::string_view xml) {
  constexpr std::string_view attribute = "srsName";
  constexpr std::size_t max_names = 4, longest = 400;
  std::vector<std::string> names;
  for (std::size_t at = xml.find(attribute); at != std::string_view::npos && names.size() < max_names;
       at = xml.find(attribute, at)) {
    at = xml.find_first_not_of(" =\t\r\n", at + attribute.size());
    if (at == std::string_view::npos || (xml[at] != '"' && xml[at] != '\'')) continue;
    const std::size_t end = xml.find(xml[at], at + 1);
    if (end == std::string_view::npos || end - at > longest) continue;
    const std::string name(xml.substr(at + 1, end - at - 1));
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

/// A file in the elements of CityGML 1 or 2.
struct Gml2 {
  std::string text;
  std::string system;  ///< of its coordinates, the first that it names; may be empty
  std::vector<GeoreferencedTexture> draped;
};

/// A file may name its system in several ways, but only one system.
std::string system_of(const std::string& xml, const FileLocation& where, Errors& warnings) {
  const std::vector<std::string> names = system_names(xml);
  if (names.empty()) return "";
  for (const std::string& name : names)
    if (epsg_in(name) && epsg_in(names.front()) && epsg_in(name) != epsg_in(names.front())) {
      warnings.push_back(error_at(where,
                                  "it names several coordinate systems, \"{}\" and \"{}\": all of it is read "
                                  "as of the first. Convert it to one",
                                  names.front(), name));
      break;
    }
  return names.front();
}

Result<Gml2> read_gml_2(const std::filesystem::path& file, Errors& warnings, FileAccount* account) {
  const FileLocation where{file.string(), 0, 0};
  FileAccount unasked("CityGML");
  FileAccount& held = account ? *account : unasked;
  Result<XmlText> xml = read_xml(file, [&](const char* name, const char**) {
    const std::string_view whole(name),
        local = whole.substr(whole.find(':') + 1);  // all of it without a prefix
    if (local == "MultiCurve" || local == "MultiPoint")
      held.left_out("geometries " + std::string(local), "points and lines are not drawn");
  });
  if (!xml) return xml.errors();
  if (xml->root.find("CityModel") == std::string::npos)
    return error_at(where, "this is no CityGML: its outermost element is <{}>; expected <CityModel>",
                    xml->root.substr(0, xml->root.find(' ')));
  xml->bytes = without_gml_extensions(plain_gml_geometry(std::move(xml->bytes)), held);
  Gml2 read{{}, system_of(xml->bytes, where, warnings), georeferenced_textures(xml->bytes)};
  if (is_city_gml_3(xml->root)) {
    Result<std::string> text = city_gml_2_of(xml->bytes, where);
    if (!text) return text.errors();
    read.text = *std::move(text);
  } else {
    read.text = std::move(xml->bytes);
  }
  return read;
}

/// Polygons and triangles of a text.
std::size_t polygons_written(std::string_view xml) {
  std::size_t count = 0;
  for (const std::string_view name : {"Polygon", "Triangle"})
    for (std::size_t at = xml.find(name); at != std::string_view::npos; at = xml.find(name, at + 1)) {
      const bool begins =
          at > 0 && (xml[at - 1] == '<' || (xml[at - 1] == ':' && xml.rfind('<', at) > xml.rfind('>', at) &&
                                            xml[xml.rfind('<', at) + 1] != '/'));
      const char next = at + name.size() < xml.size() ? xml[at + name.size()] : ' ';
      if (begins && (next == '>' || next == ' ' || next == '\n' || next == '\r' || next == '\t')) ++count;
    }
  return count;
}

/// Those that the library has made of it, each once.
std::size_t polygons_made(const citygml::CityModel& city) {
  std::set<const citygml::Polygon*> polygons;
  const std::function<void(const citygml::Geometry&)> of_geometry = [&](const citygml::Geometry& geometry) {
    for (unsigned i = 0; i < geometry.getPolygonsCount(); ++i) polygons.insert(geometry.getPolygon(i).get());
    for (unsigned i = 0; i < geometry.getGeometriesCount(); ++i) of_geometry(geometry.getGeometry(i));
  };
  const std::function<void(const citygml::CityObject&)> of_object = [&](const citygml::CityObject& object) {
    each_geometry(object,
                  [&](const citygml::Geometry& geometry, const Placement&) { of_geometry(geometry); });
    for (unsigned i = 0; i < object.getChildCityObjectsCount(); ++i) of_object(object.getChildCityObject(i));
  };
  for (const citygml::CityObject* object : city.getRootCityObjects()) of_object(*object);
  return polygons.size();
}

Result<Model> read(const std::filesystem::path& file, Errors& warnings, std::optional<double> max_detail,
                   std::optional<glm::dvec2>* place_deg, const std::string& map, FileAccount* account) {
  const FileLocation where{file.string(), 0, 0};
  Result<Gml2> gml = read_gml_2(file, warnings, account);
  if (!gml) return gml.errors();
  const auto complaints = std::make_shared<Complaints>();
  citygml::ParserParams wanted;
  wanted.tesselate = false;  // rings are kept as they are; the assembly makes triangles
  wanted.keepVertices = true;
  try {
    const std::size_t held = polygons_written(gml->text);
    std::istringstream stream(std::move(gml->text));
    const auto city = citygml::load(stream, wanted, complaints);
    if (!city) return error_at(where, "libcitygml cannot read it ({})", complaints->first());
    Result<CityCoordinates> coordinates =
        CityCoordinates::find(Clues(*city, gml->system).get(), file, warnings, map);
    if (!coordinates) return coordinates.errors();
    if (place_deg) *place_deg = coordinates->place_deg();
    if (account)
      account->settle("polygons", held, std::min(held, polygons_made(*city)),
                      "libcitygml makes nothing of them, or of what they belong to");
    std::vector<GeoreferencedTexture> draped =
        placed_textures(std::move(gml->draped), coordinates->are_plane(), file, warnings);
    return CityGmlReader(file, *city, *std::move(coordinates), std::move(draped), warnings, max_detail)
        .read();
  } catch (const std::exception& problem) {
    return error_at(where, "libcitygml cannot read it ({})", reason_of(problem));
  } catch (...) {  // Xerces throws what is no std::exception
    return error_at(where, "libcitygml cannot read it ({})", complaints->first());
  }
}

}  // namespace
}  // namespace parvis::scene

PARVIS_MODULE(parvis::scene::CityGmlFunctions){parvis::scene::read};
