// The node terrain_plane: ground between houses and land to the horizon.
#pragma once

#include "scene/script/node_registry.h"

namespace parvis::dressing {

/// Adds the node type terrain_plane and the finish step that lays the ground.
void add_terrain_nodes(scene::NodeRegistry& registry);

}  // namespace parvis::dressing
