// Nodes for city models that are bare volumes: facades, roofs, ground, greenery.
#pragma once

#include "scene/script/node_registry.h"

namespace parvis::dressing {

/// Adds the node types facades, roofs, ground and greenery, which change the model that they stand in.
void add_surface_nodes(scene::NodeRegistry& registry);

}  // namespace parvis::dressing
