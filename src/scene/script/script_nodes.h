// The node types that any scene has.
#pragma once

#include "scene/script/node_registry.h"

namespace parvis::scene {

// Their families, each with a file nodes_FAMILY.cpp.
void add_grouping_nodes(NodeRegistry& registry);  ///< include, group
void add_camera_nodes(NodeRegistry& registry);    ///< camera
void add_scenario_nodes(NodeRegistry& registry);  ///< scenario, override

}  // namespace parvis::scene
