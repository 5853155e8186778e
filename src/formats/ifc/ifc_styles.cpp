#include "formats/ifc/ifc_styles.h"

#include <ifcpp/IFC4/include/IfcMaterial.h>
#include <ifcpp/IFC4/include/IfcMaterialConstituent.h>
#include <ifcpp/IFC4/include/IfcMaterialConstituentSet.h>
#include <ifcpp/IFC4/include/IfcMaterialDefinitionRepresentation.h>
#include <ifcpp/IFC4/include/IfcMaterialLayer.h>
#include <ifcpp/IFC4/include/IfcMaterialLayerSet.h>
#include <ifcpp/IFC4/include/IfcMaterialLayerSetUsage.h>
#include <ifcpp/IFC4/include/IfcMaterialList.h>
#include <ifcpp/IFC4/include/IfcMaterialProfile.h>
#include <ifcpp/IFC4/include/IfcMaterialProfileSet.h>
#include <ifcpp/IFC4/include/IfcMaterialProfileSetUsage.h>
#include <ifcpp/IFC4/include/IfcMaterialSelect.h>
#include <ifcpp/IFC4/include/IfcObject.h>
#include <ifcpp/IFC4/include/IfcPresentationStyleAssignment.h>
#include <ifcpp/IFC4/include/IfcRelAssociatesMaterial.h>
#include <ifcpp/IFC4/include/IfcRelDefinesByType.h>
#include <ifcpp/IFC4/include/IfcRepresentation.h>
#include <ifcpp/IFC4/include/IfcRepresentationItem.h>
#include <ifcpp/IFC4/include/IfcStyledItem.h>
#include <ifcpp/IFC4/include/IfcSurfaceStyle.h>
#include <ifcpp/IFC4/include/IfcTypeObject.h>

namespace parvis::scene {
namespace {

using Materials = std::vector<const IfcMaterial*>;

/// Appends the material of each element of a set: layers, profiles, constituents.
template <class Elements>
void append_materials_of(const Elements& elements, Materials& materials) {
  for (const auto& element : elements)
    if (element) materials.push_back(element->m_Material.get());
}

/// The materials that a choice among the ways to give them names.
Materials materials_of(const IfcMaterialSelect* given) {
  Materials materials;
  if (const auto* usage = dynamic_cast<const IfcMaterialLayerSetUsage*>(given))
    given = usage->m_ForLayerSet.get();
  else if (const auto* profiled = dynamic_cast<const IfcMaterialProfileSetUsage*>(given))
    given = profiled->m_ForProfileSet.get();
  if (const auto* material = dynamic_cast<const IfcMaterial*>(given))
    materials.push_back(material);
  else if (const auto* layers = dynamic_cast<const IfcMaterialLayerSet*>(given))
    append_materials_of(layers->m_MaterialLayers, materials);
  else if (const auto* layer = dynamic_cast<const IfcMaterialLayer*>(given))
    materials.push_back(layer->m_Material.get());
  else if (const auto* profiles = dynamic_cast<const IfcMaterialProfileSet*>(given))
    append_materials_of(profiles->m_MaterialProfiles, materials);
  else if (const auto* constituents = dynamic_cast<const IfcMaterialConstituentSet*>(given))
    append_materials_of(constituents->m_MaterialConstituents, materials);
  else if (const auto* list = dynamic_cast<const IfcMaterialList*>(given))
    for (const auto& each : list->m_Materials) materials.push_back(each.get());
  return materials;
}

void append_styles_of(const IfcMaterial& material, std::vector<const IfcSurfaceStyle*>& styles) {
  for (const auto& defined : material.m_HasRepresentation_inverse)
    if (const auto definition = defined.lock())
      for (const auto& representation : definition->m_Representations) {
        if (!representation) continue;
        for (const auto& item : representation->m_Items) {
          const std::vector<const IfcSurfaceStyle*> own = styles_of(item.get());
          styles.insert(styles.end(), own.begin(), own.end());
        }
      }
}

}  // namespace

std::vector<const IfcSurfaceStyle*> styles_of(const BuildingEntity* entity) {
  std::vector<const IfcSurfaceStyle*> found;
  if (const auto* style = dynamic_cast<const IfcSurfaceStyle*>(entity)) found.push_back(style);
  if (const auto* item = dynamic_cast<const IfcStyledItem*>(entity))
    for (const auto& each : item->m_Styles) {
      if (const auto* style = dynamic_cast<const IfcSurfaceStyle*>(each.get())) found.push_back(style);
      if (const auto* assigned = dynamic_cast<const IfcPresentationStyleAssignment*>(each.get()))
        for (const auto& one : assigned->m_Styles)
          if (const auto* style = dynamic_cast<const IfcSurfaceStyle*>(one.get())) found.push_back(style);
    }
  return found;
}

std::vector<const IfcSurfaceStyle*> material_styles_of(const IfcObjectDefinition& object) {
  std::vector<const IfcSurfaceStyle*> styles;
  for (const auto& association : object.m_HasAssociations_inverse)
    if (const auto relation = std::dynamic_pointer_cast<IfcRelAssociatesMaterial>(association.lock()))
      for (const IfcMaterial* material : materials_of(relation->m_RelatingMaterial.get()))
        if (material) append_styles_of(*material, styles);
  if (!styles.empty()) return styles;
  if (const auto* typed = dynamic_cast<const IfcObject*>(&object))
    for (const auto& by_type : typed->m_IsTypedBy_inverse)
      if (const auto relation = by_type.lock(); relation && relation->m_RelatingType && styles.empty())
        styles = material_styles_of(*relation->m_RelatingType);
  return styles;
}

}  // namespace parvis::scene
