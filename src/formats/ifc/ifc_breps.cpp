#include "formats/ifc/ifc_breps.h"

#include <ifcpp/IFC4/include/IfcBoolean.h>
#include <ifcpp/IFC4/include/IfcBooleanResult.h>
#include <ifcpp/IFC4/include/IfcCartesianPoint.h>
#include <ifcpp/IFC4/include/IfcClosedShell.h>
#include <ifcpp/IFC4/include/IfcFace.h>
#include <ifcpp/IFC4/include/IfcFaceOuterBound.h>
#include <ifcpp/IFC4/include/IfcFacetedBrep.h>
#include <ifcpp/IFC4/include/IfcLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcPolyLoop.h>
#include <ifcpp/IFC4/include/IfcPositiveLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcRepresentation.h>
#include <ifcpp/IFC4/include/IfcStyledItem.h>
#include <ifcpp/model/BuildingModel.h>

#include <algorithm>
#include <cmath>

namespace parvis::scene {

using glm::dvec3;

Ring reversed(Ring ring) {
  std::ranges::reverse(ring);
  return ring;
}

void add_side(const Ring& below, const Ring& above, bool is_plane, Faces& faces) {
  for (std::size_t i = 0; i < below.size(); ++i) {
    const std::size_t next = (i + 1) % below.size();
    if (is_plane) {
      faces.push_back({{below[i], below[next], above[next], above[i]}});
      continue;
    }
    faces.push_back({{below[i], below[next], above[next]}});
    faces.push_back({{below[i], above[next], above[i]}});
  }
}

std::shared_ptr<IfcFacetedBrep> brep_of(const Faces& faces, double metres_per_unit) {
  const auto shell = std::make_shared<IfcClosedShell>();
  for (const std::vector<Ring>& rings : faces) {
    const auto face = std::make_shared<IfcFace>();
    for (const Ring& ring : rings) {
      const auto loop = std::make_shared<IfcPolyLoop>();
      for (const dvec3& corner : ring) {
        const auto point = std::make_shared<IfcCartesianPoint>();
        for (int axis = 0; axis < 3; ++axis)
          point->m_Coordinates.push_back(std::make_shared<IfcLengthMeasure>(corner[axis] / metres_per_unit));
        loop->m_Polygon.push_back(point);
      }
      const std::shared_ptr<IfcFaceBound> bound =
          face->m_Bounds.empty() ? std::make_shared<IfcFaceOuterBound>() : std::make_shared<IfcFaceBound>();
      bound->m_Bound = loop;
      bound->m_Orientation = std::make_shared<IfcBoolean>(true);
      face->m_Bounds.push_back(bound);
    }
    shell->m_CfsFaces.push_back(face);
  }
  auto brep = std::make_shared<IfcFacetedBrep>();
  brep->m_Outer = shell;
  return brep;
}

double metres_of(const std::shared_ptr<IfcPositiveLengthMeasure>& length, double metres_per_unit) {
  return length && std::isfinite(length->m_value) ? length->m_value * metres_per_unit : 0.0;
}

void ReplacedBodies::add(const BuildingEntity& entity, const std::shared_ptr<IfcFacetedBrep>& body) {
  const auto& item = dynamic_cast<const IfcRepresentationItem&>(entity);
  body->m_entity_id = entity.m_entity_id;
  body->m_StyledByItem_inverse = item.m_StyledByItem_inverse;
  body->m_LayerAssignment_inverse = item.m_LayerAssignment_inverse;
  bodies_.emplace(&entity, body);
}

void ReplacedBodies::put_into(BuildingModel& building) const {
  if (bodies_.empty()) return;
  const auto put_in = [this](auto& place) {
    const auto* entity = dynamic_cast<const BuildingEntity*>(place.get());
    if (const auto found = bodies_.find(entity); entity && found != bodies_.end()) place = found->second;
  };
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    if (auto* representation = dynamic_cast<IfcRepresentation*>(entity.get()))
      for (auto& item : representation->m_Items) put_in(item);
    if (auto* result = dynamic_cast<IfcBooleanResult*>(entity.get()))
      put_in(result->m_FirstOperand), put_in(result->m_SecondOperand);
    if (auto* styled = dynamic_cast<IfcStyledItem*>(entity.get())) put_in(styled->m_Item);
  }
}

}  // namespace parvis::scene
