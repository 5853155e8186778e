// View-dependent objects (thesis, section 5.3.4 and appendix A.1): models of one thing, each textured from
// another viewpoint.
#pragma once

#include "base/house.h"

namespace parvis::view_dependent_objects {

/// Adds the node vdobject, and what draws and traces it.
void furnish(House& house);

}  // namespace parvis::view_dependent_objects
