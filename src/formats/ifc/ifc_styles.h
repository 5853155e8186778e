// Surface styles of an IFC file: what names them, and those of the materials that objects are made of. A part
// of the module ifcplusplus.
#pragma once

#include <vector>

class BuildingEntity;
class IfcObjectDefinition;
class IfcSurfaceStyle;

namespace parvis::scene {

/// The surface styles of an entity: itself, or what a styled item names.
std::vector<const IfcSurfaceStyle*> styles_of(const BuildingEntity* entity);

/// Those of the materials of an object (IfcRelAssociatesMaterial, IfcMaterialDefinitionRepresentation), or,
/// where it has none of its own, of its type; of walls of several layers in the order of these.
std::vector<const IfcSurfaceStyle*> material_styles_of(const IfcObjectDefinition& object);

}  // namespace parvis::scene
