// The node noiseMap.
#pragma once

#include "scene/script/node_registry.h"

namespace parvis::noise {

/// Adds `noiseMap` and the step that computes maps when all nodes are built.
void add_map_node(scene::NodeRegistry& registry);

}  // namespace parvis::noise
