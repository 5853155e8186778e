// The module `ifcplusplus`: what of this room knows IFC++.
#pragma once

#include "base/module.h"
#include "formats/ifc/ifc_shapes.h"

namespace parvis::scene {

/// The functions of the module that calls IFC++.
struct IfcFunctions {
  Result<IfcBodies> (*bodies)(std::string text, const std::string& name, Errors& warnings);
};

/// Loaded in the workers' server when the first .ifc is read.
inline constexpr Module<IfcFunctions> ifcplusplus("ifcplusplus");

}  // namespace parvis::scene
