// The node types of models, their materials and wheels.
#pragma once

#include "formats/readers/readers.h"
#include "scene/script/node_registry.h"

namespace parvis::scene {

// The node types, each with a file nodes_FAMILY.cpp. `readers` must outlive the registry.
/// model.
void add_model_node(NodeRegistry& registry, const formats::Readers& readers);
/// object.
void add_object_node(NodeRegistry& registry, const formats::Readers& readers);
void add_material_nodes(NodeRegistry& registry);  ///< material
void add_wheel_nodes(NodeRegistry& registry);     ///< wheels

}  // namespace parvis::scene
