// What this room brings to the house: models, their materials and wheels; and the reader of meshes.
#pragma once

#include "base/house.h"
#include "formats/readers/readers.h"
#include "scene/script/node_registry.h"

namespace parvis::scene {

/// model, object, material, wheels; the reader of every file that no other room reads.
void furnish_meshes(House& house);

// The node types, each with a file nodes_FAMILY.cpp. `readers` must outlive the registry.
/// model.
void add_model_node(NodeRegistry& registry, const formats::Readers& readers);
/// object.
void add_object_node(NodeRegistry& registry, const formats::Readers& readers);
void add_material_nodes(NodeRegistry& registry);  ///< material
void add_wheel_nodes(NodeRegistry& registry);     ///< wheels

}  // namespace parvis::scene
