// The node type of this room: where a scene's reference maps are taken.
#pragma once

#include "scene/script/node_registry.h"

namespace parvis::reference_maps {

/// referenceMaps.
void add_reference_map_node(scene::NodeRegistry& registry);

}  // namespace parvis::reference_maps
