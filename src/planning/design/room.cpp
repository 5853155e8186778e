#include "planning/design/room.h"

#include "planning/design/design_nodes.h"

namespace parvis::design {

void furnish(House& house) { add_design_nodes(house); }

}  // namespace parvis::design
