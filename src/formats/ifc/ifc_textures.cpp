#include "formats/ifc/ifc_textures.h"

#include <fmt/format.h>
#include <ifcpp/IFC4/include/IfcBinary.h>
#include <ifcpp/IFC4/include/IfcBlobTexture.h>
#include <ifcpp/IFC4/include/IfcBoolean.h>
#include <ifcpp/IFC4/include/IfcCartesianPoint.h>
#include <ifcpp/IFC4/include/IfcCartesianPointList3D.h>
#include <ifcpp/IFC4/include/IfcCartesianTransformationOperator2D.h>
#include <ifcpp/IFC4/include/IfcDirection.h>
#include <ifcpp/IFC4/include/IfcFace.h>
#include <ifcpp/IFC4/include/IfcFaceBound.h>
#include <ifcpp/IFC4/include/IfcIdentifier.h>
#include <ifcpp/IFC4/include/IfcImageTexture.h>
#include <ifcpp/IFC4/include/IfcIndexedTriangleTextureMap.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcParameterValue.h>
#include <ifcpp/IFC4/include/IfcPolyLoop.h>
#include <ifcpp/IFC4/include/IfcPositiveInteger.h>
#include <ifcpp/IFC4/include/IfcReal.h>
#include <ifcpp/IFC4/include/IfcSurfaceStyle.h>
#include <ifcpp/IFC4/include/IfcSurfaceStyleWithTextures.h>
#include <ifcpp/IFC4/include/IfcTextureMap.h>
#include <ifcpp/IFC4/include/IfcTextureVertex.h>
#include <ifcpp/IFC4/include/IfcTextureVertexList.h>
#include <ifcpp/IFC4/include/IfcTriangulatedFaceSet.h>
#include <ifcpp/IFC4/include/IfcURIReference.h>
#include <ifcpp/model/BuildingModel.h>
#include <ifcpp/model/UnitConverter.h>

#include <algorithm>
#include <cmath>

#include "formats/ifc/ifc_styles.h"
#include "formats/ifc/ifc_text.h"

namespace parvis::scene {
namespace {

using glm::dvec2, glm::dvec3;

constexpr double same_place_m = 1e-4;

/// Bits as STEP writes them: a digit for the number of unused bits, then digits of four bits each.
std::string bytes_of_binary(const std::wstring& text) {
  std::string digits;
  for (const wchar_t letter : text) {
    if (letter >= L'0' && letter <= L'9') digits += char(letter - L'0');
    if (letter >= L'A' && letter <= L'F') digits += char(letter - L'A' + 10);
    if (letter >= L'a' && letter <= L'f') digits += char(letter - L'a' + 10);
  }
  std::string bytes;
  for (std::size_t i = 1; i + 1 < digits.size(); i += 2)
    bytes += char((unsigned(digits[i]) << 4u) | unsigned(digits[i + 1]));
  return bytes;
}

dvec3 point_of(const std::vector<shared_ptr<IfcLengthMeasure>>& coordinates, double metres) {
  dvec3 point(0.0);
  for (int axis = 0; axis < 3 && std::size_t(axis) < coordinates.size(); ++axis)
    if (coordinates[std::size_t(axis)]) point[axis] = metres * coordinates[std::size_t(axis)]->m_value;
  return point;
}

std::optional<dvec2> uv_of(const std::vector<shared_ptr<IfcParameterValue>>& values) {
  if (values.size() < 2 || !values[0] || !values[1]) return std::nullopt;
  return dvec2(values[0]->m_value, values[1]->m_value);
}

glm::dmat3 matrix_of(const IfcCartesianTransformationOperator2D* given) {
  if (!given) return glm::dmat3(1.0);
  const double scale = given->m_Scale ? given->m_Scale->m_value : 1.0;
  dvec2 along(1.0, 0.0), origin(0.0);
  if (given->m_Axis1 && given->m_Axis1->m_DirectionRatios.size() > 1 &&
      given->m_Axis1->m_DirectionRatios[0] && given->m_Axis1->m_DirectionRatios[1])
    along = {given->m_Axis1->m_DirectionRatios[0]->m_value, given->m_Axis1->m_DirectionRatios[1]->m_value};
  if (glm::length(along) > 1e-9) along = glm::normalize(along);
  if (given->m_LocalOrigin) origin = dvec2(point_of(given->m_LocalOrigin->m_Coordinates, 1.0));
  glm::dmat3 matrix(dvec3(scale * along, 0.0), dvec3(scale * dvec2(-along.y, along.x), 0.0),
                    dvec3(origin, 1.0));
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (!std::isfinite(matrix[column][row])) return glm::dmat3(1.0);
  return matrix;
}

std::array<std::int64_t, 3> place_of(dvec3 point) {
  const dvec3 cell = glm::round(glm::clamp(point, -1e9, 1e9) / same_place_m);
  return {std::int64_t(cell.x), std::int64_t(cell.y), std::int64_t(cell.z)};
}

/// Metres along the surface, to the right and up.
dvec2 along_surface(dvec3 point, dvec3 normal) {
  if (std::abs(normal.z) > 0.7 * glm::length(normal)) return dvec2(point);
  return {glm::dot(dvec2(point), glm::normalize(dvec2(-normal.y, normal.x))), point.z};
}

}  // namespace

IfcTextures::IfcTextures(BuildingModel& building, std::function<void(const std::string&)> warn)
    : building_(building), warn_(std::move(warn)) {
  if (building.getUnitConverter()) metres_ = building.getUnitConverter()->getLengthInMeterFactor();
}

std::optional<std::size_t> IfcTextures::picture_of_style(int number) {
  const auto [known, is_new] = picture_of_style_.try_emplace(number, std::nullopt);
  if (!is_new) return known->second;
  std::optional<std::size_t> picture;
  const auto entity = building_.getMapIfcEntities().find(number);
  if (entity == building_.getMapIfcEntities().end()) return picture;
  for (const IfcSurfaceStyle* style : styles_of(entity->second.get()))
    for (const auto& element : style->m_Styles)
      if (const auto* textured = dynamic_cast<const IfcSurfaceStyleWithTextures*>(element.get()))
        for (const auto& texture : textured->m_Textures)
          if (!picture && texture) picture = add(texture);
  return picture_of_style_[number] = picture;
}

std::optional<std::size_t> IfcTextures::add(const shared_ptr<IfcSurfaceTexture>& texture) {
  const auto [known, is_new] = picture_of_texture_.try_emplace(texture->m_entity_id, std::nullopt);
  if (!is_new) return known->second;
  IfcPicture picture;
  if (const auto* image = dynamic_cast<const IfcImageTexture*>(texture.get())) {
    if (image->m_URLReference) picture.name = utf8(image->m_URLReference->m_value);
    std::ranges::replace(picture.name, '\\', '/');
    if (picture.name.empty() || picture.name.find("://") != std::string::npos) {
      warn_(fmt::format(
          "#{}: the picture \"{}\" is no file beside the IFC file; its surface has its colour alone: "
          "save the picture there and give its name",
          texture->m_entity_id, picture.name));
      return std::nullopt;
    }
  } else if (const auto* blob = dynamic_cast<const IfcBlobTexture*>(texture.get())) {
    picture.name = fmt::format("#{}", texture->m_entity_id);
    if (blob->m_RasterCode) picture.bytes = bytes_of_binary(blob->m_RasterCode->m_value);
    if (picture.bytes.empty()) {
      warn_(
          fmt::format("{}: its IfcBlobTexture holds no bytes; its surface has its colour alone: export the "
                      "pictures as files",
                      picture.name));
      return std::nullopt;
    }
  } else {
    warn_(fmt::format(
        "#{}: an {} is not read; its surface has its colour alone: export pictures as IfcImageTexture "
        "or IfcBlobTexture",
        texture->m_entity_id, texture->className()));
    return std::nullopt;
  }
  picture.repeats = !texture->m_RepeatS || texture->m_RepeatS->m_value;
  Mapping mapping;
  mapping.transform = matrix_of(texture->m_TextureTransform.get());
  for (const auto& coordinates : texture->m_IsMappedBy_inverse)
    if (const auto given = coordinates.lock()) read_coordinates(*given, mapping);
  pictures_.push_back(std::move(picture)), mappings_.push_back(std::move(mapping));
  return picture_of_texture_[texture->m_entity_id] = pictures_.size() - 1;
}

void IfcTextures::read_coordinates(const IfcTextureCoordinate& coordinates, Mapping& mapping) {
  const auto add = [&](Polygon polygon) {
    for (const auto& [place, uv] : polygon)
      mapping.polygons_at[place].push_back(std::uint32_t(mapping.polygons.size()));
    mapping.polygons.push_back(std::move(polygon));
  };
  if (const auto* map = dynamic_cast<const IfcIndexedTriangleTextureMap*>(&coordinates)) {
    const auto* set = dynamic_cast<const IfcTriangulatedFaceSet*>(map->m_MappedTo.get());
    if (!set || !set->m_Coordinates || !map->m_TexCoords) return;
    const auto& list = set->m_Coordinates->m_CoordList;
    const auto& uv_list = map->m_TexCoords->m_TexCoordsList;
    const auto& uv_index = map->m_TexCoordIndex.empty() ? set->m_CoordIndex : map->m_TexCoordIndex;
    for (std::size_t t = 0; t < std::min(set->m_CoordIndex.size(), uv_index.size()); ++t) {
      Polygon triangle;
      for (std::size_t k = 0; k < std::min(set->m_CoordIndex[t].size(), uv_index[t].size()); ++k) {
        if (!set->m_CoordIndex[t][k] || !uv_index[t][k]) continue;
        std::size_t point = std::size_t(std::max(set->m_CoordIndex[t][k]->m_value, 0));
        if (!set->m_PnIndex.empty()) {
          if (point < 1 || point > set->m_PnIndex.size() || !set->m_PnIndex[point - 1]) continue;
          point = std::size_t(std::max(set->m_PnIndex[point - 1]->m_value, 0));
        }
        const std::size_t uv = std::size_t(std::max(uv_index[t][k]->m_value, 0));
        if (point < 1 || point > list.size() || uv < 1 || uv > uv_list.size()) continue;
        if (const auto given = uv_of(uv_list[uv - 1]))
          triangle.emplace(place_of(point_of(list[point - 1], metres_)), *given);
      }
      add(std::move(triangle));
    }
  } else if (const auto* face_map = dynamic_cast<const IfcTextureMap*>(&coordinates)) {
    if (!face_map->m_MappedTo || face_map->m_MappedTo->m_Bounds.empty() || !face_map->m_MappedTo->m_Bounds[0])
      return;
    const auto* loop = dynamic_cast<const IfcPolyLoop*>(face_map->m_MappedTo->m_Bounds[0]->m_Bound.get());
    if (!loop) return;
    Polygon face;
    for (std::size_t k = 0; k < std::min(loop->m_Polygon.size(), face_map->m_Vertices.size()); ++k) {
      if (!loop->m_Polygon[k] || !face_map->m_Vertices[k]) continue;
      if (const auto given = uv_of(face_map->m_Vertices[k]->m_Coordinates))
        face.emplace(place_of(point_of(loop->m_Polygon[k]->m_Coordinates, metres_)), *given);
    }
    add(std::move(face));
  }
}

/// The face that a triangle was cut from; null where the file gives it no coordinates. Faces are looked for
/// at the corner that the fewest of them share.
const IfcTextures::Polygon* IfcTextures::polygon_with(const std::array<Place, 3>& corners,
                                                      const Mapping& mapping) {
  const std::vector<std::uint32_t>* fewest = nullptr;
  for (const Place& corner : corners) {
    const auto at = mapping.polygons_at.find(corner);
    if (at == mapping.polygons_at.end()) return nullptr;
    if (!fewest || at->second.size() < fewest->size()) fewest = &at->second;
  }
  for (const std::uint32_t index : *fewest) {
    const Polygon& polygon = mapping.polygons[index];
    if (std::ranges::all_of(corners, [&](const Place& corner) { return polygon.contains(corner); }))
      return &polygon;
  }
  return nullptr;
}

std::array<glm::vec2, 3> IfcTextures::coordinates(std::size_t picture, const std::array<dvec3, 3>& corners) {
  const Mapping& mapping = mappings_[picture];
  const dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const std::array<Place, 3> places{place_of(corners[0]), place_of(corners[1]), place_of(corners[2])};
  const Polygon* given = polygon_with(places, mapping);
  std::array<glm::vec2, 3> result{};
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec2 bare = given ? given->at(places[k]) : along_surface(corners[k], normal);
    const dvec2 uv(mapping.transform * dvec3(bare, 1.0));
    result[k] = glm::vec2(uv.x, 1.0 - uv.y);
  }
  return result;
}

}  // namespace parvis::scene
