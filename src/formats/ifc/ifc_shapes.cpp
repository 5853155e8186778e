#include "formats/ifc/ifc_shapes.h"

#include "formats/ifc/ifcplusplus_module.h"
#include "formats/terrain/map_system.h"

namespace parvis::scene {

Result<IfcBodies> ifc_bodies(std::string text, const std::string& name, Errors& warnings) {
  if (const Status known = projections_known(); !known) return known.errors();  // of its place on a map
  return ifcplusplus.call(&IfcFunctions::bodies, std::move(text), name, warnings);
}

}  // namespace parvis::scene
