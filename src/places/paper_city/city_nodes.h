// The node types of this room: facades, roofs, ground, greenery.
#pragma once

#include "scene/node_registry.h"

namespace parvis::city {

void add_city_nodes(scene::NodeRegistry& registry);

}  // namespace parvis::city
