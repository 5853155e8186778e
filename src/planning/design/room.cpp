#include "base/registries.h"
#include "planning/design/design_nodes.h"
#include "room_list.h"

namespace parvis::design {

/// Adds the node types of this room.
void register_room(Registries& registries) { add_design_nodes(registries); }

}  // namespace parvis::design
