#include "base/house.h"
#include "room_list.h"
#include "scene/script/script_nodes.h"

namespace parvis::script {

/// Adds include, group; camera; scenario, override.
void furnish(House& house) {
  scene::NodeRegistry& registry = house.get<scene::NodeRegistry>();
  scene::add_grouping_nodes(registry);
  scene::add_camera_nodes(registry);
  scene::add_scenario_nodes(registry);
}

}  // namespace parvis::script
