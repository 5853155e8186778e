#include "formats/ifc/ifc_primitives.h"

#include <ifcpp/IFC4/include/IfcAxis2Placement3D.h>
#include <ifcpp/IFC4/include/IfcBlock.h>
#include <ifcpp/IFC4/include/IfcBooleanResult.h>
#include <ifcpp/IFC4/include/IfcBoxedHalfSpace.h>
#include <ifcpp/IFC4/include/IfcCsgSolid.h>
#include <ifcpp/IFC4/include/IfcFacetedBrep.h>
#include <ifcpp/IFC4/include/IfcPositiveLengthMeasure.h>
#include <ifcpp/IFC4/include/IfcRectangularPyramid.h>
#include <ifcpp/IFC4/include/IfcRightCircularCone.h>
#include <ifcpp/IFC4/include/IfcRightCircularCylinder.h>
#include <ifcpp/IFC4/include/IfcSphere.h>
#include <ifcpp/geometry/Carve/GeometryConverter.h>
#include <ifcpp/model/BuildingModel.h>

#include <cmath>
#include <numbers>

#include "formats/ifc/ifc_breps.h"

namespace parvis::scene {
namespace {

using glm::dvec3;

Ring rectangle(double x_m, double y_m, double z_m) {
  return {{0.0, 0.0, z_m}, {x_m, 0.0, z_m}, {x_m, y_m, z_m}, {0.0, y_m, z_m}};
}

Ring circle(double radius_m, double z_m, int corners) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    ring.emplace_back(radius_m * std::cos(angle), radius_m * std::sin(angle), z_m);
  }
  return ring;
}

Faces prism(const Ring& below, const Ring& above) {
  Faces faces{{reversed(below)}, {above}};
  add_side(below, above, true, faces);
  return faces;
}

/// Triangles from a ring, counter-clockwise seen from the tip.
void add_tip(const Ring& ring, dvec3 tip, Faces& faces) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    faces.push_back({{ring[i], ring[(i + 1) % ring.size()], tip}});
}

Faces ball(double radius_m, int corners) {
  Faces faces;
  const int levels = corners / 2;
  const auto level = [&](int i) {
    const double angle = std::numbers::pi * i / levels;
    return circle(radius_m * std::sin(angle), -radius_m * std::cos(angle), corners);
  };
  add_tip(reversed(level(1)), {0.0, 0.0, -radius_m}, faces);
  for (int i = 1; i + 1 < levels; ++i) add_side(level(i), level(i + 1), false, faces);
  add_tip(level(levels - 1), {0.0, 0.0, radius_m}, faces);
  return faces;
}

/// The faces of a primitive in its own frame; none where it is of another kind or has no size.
Faces faces_of(const BuildingEntity& entity, double unit_m, GeometrySettings& settings) {
  const auto corners = [&](double radius_m) { return settings.getNumVerticesPerCircleWithRadius(radius_m); };
  if (const auto* block = dynamic_cast<const IfcBlock*>(&entity)) {
    const double x = metres_of(block->m_XLength, unit_m), y = metres_of(block->m_YLength, unit_m),
                 z = metres_of(block->m_ZLength, unit_m);
    return x > 0.0 && y > 0.0 && z > 0.0 ? prism(rectangle(x, y, 0.0), rectangle(x, y, z)) : Faces();
  }
  if (const auto* pyramid = dynamic_cast<const IfcRectangularPyramid*>(&entity)) {
    const double x = metres_of(pyramid->m_XLength, unit_m), y = metres_of(pyramid->m_YLength, unit_m),
                 z = metres_of(pyramid->m_Height, unit_m);
    if (!(x > 0.0 && y > 0.0 && z > 0.0)) return {};
    Faces faces{{reversed(rectangle(x, y, 0.0))}};
    add_tip(rectangle(x, y, 0.0), {0.5 * x, 0.5 * y, z}, faces);
    return faces;
  }
  if (const auto* cylinder = dynamic_cast<const IfcRightCircularCylinder*>(&entity)) {
    const double z = metres_of(cylinder->m_Height, unit_m), radius = metres_of(cylinder->m_Radius, unit_m);
    if (!(z > 0.0 && radius > 0.0)) return {};
    return prism(circle(radius, 0.0, corners(radius)), circle(radius, z, corners(radius)));
  }
  if (const auto* cone = dynamic_cast<const IfcRightCircularCone*>(&entity)) {
    const double z = metres_of(cone->m_Height, unit_m), radius = metres_of(cone->m_BottomRadius, unit_m);
    if (!(z > 0.0 && radius > 0.0)) return {};
    const Ring bottom = circle(radius, 0.0, corners(radius));
    Faces faces{{reversed(bottom)}};
    add_tip(bottom, {0.0, 0.0, z}, faces);
    return faces;
  }
  if (const auto* sphere = dynamic_cast<const IfcSphere*>(&entity)) {
    const double radius = metres_of(sphere->m_Radius, unit_m);
    return radius > 0.0 ? ball(radius, corners(radius)) : Faces();
  }
  return {};
}

/// Null where the entity is no primitive.
std::shared_ptr<IfcFacetedBrep> body_of_primitive(const BuildingEntity& entity,
                                                  RepresentationConverter& converter, double unit_m) {
  const auto* primitive = dynamic_cast<const IfcCsgPrimitive3D*>(&entity);
  if (!primitive) return nullptr;
  Faces faces = faces_of(entity, unit_m, *converter.getGeomSettings());
  if (faces.empty()) return nullptr;
  std::shared_ptr<TransformData> position;
  if (primitive->m_Position)
    converter.getPlacementConverter()->convertIfcAxis2Placement3D(primitive->m_Position, position);
  for (auto& rings : faces)
    for (Ring& ring : rings)
      for (dvec3& corner : ring) {
        if (!position) break;
        const vec3 at = position->m_matrix * carve::geom::VECTOR(corner.x, corner.y, corner.z);
        corner = {at.x, at.y, at.z};
      }
  return brep_of(faces, unit_m);
}

/// The half space without its box.
void unbox(std::shared_ptr<IfcBooleanOperand>& operand) {
  const auto* boxed = dynamic_cast<const IfcBoxedHalfSpace*>(operand.get());
  if (!boxed) return;
  const auto plain = std::make_shared<IfcHalfSpaceSolid>(boxed->m_entity_id);
  plain->m_BaseSurface = boxed->m_BaseSurface;
  plain->m_AgreementFlag = boxed->m_AgreementFlag;
  operand = plain;
}

}  // namespace

void replace_primitives(BuildingModel& building, RepresentationConverter& converter) {
  const double unit_m = building.getUnitConverter()->getLengthInMeterFactor();
  ReplacedBodies replaced;
  for (const auto& [id, entity] : building.getMapIfcEntities()) {
    if (const auto* solid = dynamic_cast<const IfcCsgSolid*>(entity.get())) {  // one primitive, or a boolean
      const auto* root = dynamic_cast<const BuildingEntity*>(solid->m_TreeRootExpression.get());
      if (const auto body = root ? body_of_primitive(*root, converter, unit_m) : nullptr)
        replaced.add(*entity, body);
    } else if (const auto body = entity ? body_of_primitive(*entity, converter, unit_m) : nullptr) {
      replaced.add(*entity, body);
    }
    if (auto* result = dynamic_cast<IfcBooleanResult*>(entity.get()))
      unbox(result->m_FirstOperand), unbox(result->m_SecondOperand);
  }
  replaced.put_into(building);
}

}  // namespace parvis::scene
