// The node sunPath.
#pragma once

#include "scene/script/node_registry.h"

namespace parvis::light {

/// Adds sunPath to the nodes that scripts may use.
void add_sun_path_node(scene::NodeRegistry& registry);

}  // namespace parvis::light
