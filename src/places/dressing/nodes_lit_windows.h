// The node litWindows.
#pragma once

#include "scene/script/node_registry.h"

namespace parvis::dressing {

void add_lit_windows_node(scene::NodeRegistry& registry);

}  // namespace parvis::dressing
