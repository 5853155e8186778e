#include "scene/script/script_nodes.h"

namespace parvis::scene {

void furnish_script(House& house) {
  NodeRegistry& registry = house.get<NodeRegistry>();
  add_grouping_nodes(registry);
  add_camera_nodes(registry);
  add_scenario_nodes(registry);
}

}  // namespace parvis::scene
