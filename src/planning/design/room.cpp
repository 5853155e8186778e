#include "base/house.h"
#include "planning/design/design_nodes.h"
#include "room_list.h"

namespace parvis::design {

/// Adds the node types of this room.
void furnish(House& house) { add_design_nodes(house); }

}  // namespace parvis::design
