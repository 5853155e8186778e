#include "base/registries.h"
#include "planning/plan_drawing/plan_nodes.h"
#include "room_list.h"
#include "scene/script/node_registry.h"

namespace parvis::plan_drawing {

/// Adds the node types.
void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  add_drawing_node(registry);
  add_picture_node(registry);
}

}  // namespace parvis::plan_drawing
