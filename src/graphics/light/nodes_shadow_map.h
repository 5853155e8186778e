// The node shadowMap, with the spellings of the thesis's %xpShadowMap.
#pragma once

#include "scene/script/node_registry.h"

namespace parvis::light {

void add_shadow_map_node(scene::NodeRegistry& registry);

}  // namespace parvis::light
