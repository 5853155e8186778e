// The node grownTrees: the trees of a map or city model as grown plants.
#pragma once

#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"

namespace parvis::kerbside {

/// Registers the node grownTrees.
void add_map_tree_nodes(scene::NodeRegistry& registry);
/// Finish step: replaces the trees of the models that grownTrees name by grown plants. Before anything takes
/// its place along the kerbs.
void plant_map_trees(scene::SceneBuilder& builder);
/// Rebuild step: the same for the models that a node has just made.
void plant_rebuilt_map_trees(scene::SceneBuilder& builder);

}  // namespace parvis::kerbside
