#include "formats/ifc/ifc_face_sets.h"

#include <ifcpp/IFC4/include/IfcCartesianPointList3D.h>
#include <ifcpp/IFC4/include/IfcFacetedBrep.h>
#include <ifcpp/IFC4/include/IfcIndexedPolygonalFaceWithVoids.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcPolygonalFaceSet.h>
#include <ifcpp/IFC4/include/IfcPositiveInteger.h>
#include <ifcpp/model/BuildingModel.h>

#include <algorithm>
#include <optional>

#include "formats/ifc/ifc_breps.h"

namespace parvis::scene {
namespace {

using Indices = std::vector<std::shared_ptr<IfcPositiveInteger>>;

bool has_holes(const IfcPolygonalFaceSet& set) {
  return std::ranges::any_of(set.m_Faces, [](const auto& face) {
    return dynamic_cast<const IfcIndexedPolygonalFaceWithVoids*>(face.get()) != nullptr;
  });
}

/// The corners of a loop, metres; nothing where one of them is not in the file.
std::optional<Ring> ring_of(const Indices& loop, const IfcPolygonalFaceSet& set, double unit_m) {
  const auto at = [](const auto& list, const std::shared_ptr<IfcPositiveInteger>& index) {
    return index && index->m_value >= 1 && std::size_t(index->m_value) <= list.size()
               ? &list[std::size_t(index->m_value - 1)]
               : nullptr;
  };
  Ring ring;
  for (const std::shared_ptr<IfcPositiveInteger>& index : loop) {
    const auto* direct = set.m_PnIndex.empty() ? &index : at(set.m_PnIndex, index);
    const auto* point = direct ? at(set.m_Coordinates->m_CoordList, *direct) : nullptr;
    if (!point || point->size() != 3) return std::nullopt;
    glm::dvec3& corner = ring.emplace_back();
    for (int axis = 0; axis < 3; ++axis) {
      const auto& coordinate = (*point)[std::size_t(axis)];
      if (!coordinate) return std::nullopt;
      corner[axis] = coordinate->m_value * unit_m;
    }
  }
  if (ring.size() < 3) return std::nullopt;
  return ring;
}

Faces faces_of(const IfcPolygonalFaceSet& set, double unit_m) {
  Faces faces;
  for (const auto& face : set.m_Faces) {
    if (!face) continue;
    std::optional<Ring> outer = ring_of(face->m_CoordIndex, set, unit_m);
    if (!outer) continue;
    std::vector<Ring>& rings = faces.emplace_back();
    rings.push_back(*std::move(outer));
    if (const auto* holed = dynamic_cast<const IfcIndexedPolygonalFaceWithVoids*>(face.get()))
      for (const Indices& hole : holed->m_InnerCoordIndices)
        if (std::optional<Ring> ring = ring_of(hole, set, unit_m)) rings.push_back(*std::move(ring));
  }
  return faces;
}

}  // namespace

void replace_face_sets(BuildingModel& building) {
  const double unit_m = building.getUnitConverter()->getLengthInMeterFactor();
  ReplacedBodies replaced;
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    const auto* set = dynamic_cast<const IfcPolygonalFaceSet*>(entity.get());
    if (!set || !set->m_Coordinates || !has_holes(*set)) continue;
    if (const Faces faces = faces_of(*set, unit_m); !faces.empty())
      replaced.add(*entity, brep_of(faces, unit_m));
  }
  replaced.put_into(building);
}

}  // namespace parvis::scene
