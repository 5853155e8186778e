// The nodes dayLight and skyDome of the thesis (appendix A.2).
#pragma once

#include "scene/script/node_registry.h"

namespace parvis::light {

/// Adds the node types of this room.
void add_day_light_nodes(scene::NodeRegistry& registry);

}  // namespace parvis::light
