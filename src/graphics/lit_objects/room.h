// Objects that sky and sun light at their vertices (thesis, section 5.3.4 and appendix A.2.2).
#pragma once

#include "base/house.h"

namespace parvis::lit_objects {

/// Adds the node litVirtualObject and the process that lights what stands in it. After the rooms whose nodes
/// stand in it, and whose processes move things.
void furnish(House& house);

}  // namespace parvis::lit_objects
