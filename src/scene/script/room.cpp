#include "base/registries.h"
#include "room_list.h"
#include "scene/script/script_nodes.h"

namespace parvis::script {

/// Adds include, group; camera; scenario, override.
void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  scene::add_grouping_nodes(registry);
  scene::add_camera_nodes(registry);
  scene::add_scenario_nodes(registry);
}

}  // namespace parvis::script
