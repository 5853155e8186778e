// The node lamp.
#pragma once

#include "scene/script/node_registry.h"

namespace parvis::lamps {

void add_lamp_node(scene::NodeRegistry& registry);

}  // namespace parvis::lamps
