#include "formats/meshes/mesh_nodes.h"

#include "formats/meshes/mesh_formats.h"

namespace parvis::scene {

void furnish_meshes(House& house) {
  NodeRegistry& registry = house.get<NodeRegistry>();
  formats::Readers& readers = house.get<formats::Readers>();
  add_model_node(registry, readers);
  add_object_node(registry, readers);
  add_material_nodes(registry);
  add_wheel_nodes(registry);
  registry.allow(include_type, "model");
  add_mesh_formats(readers);
}

}  // namespace parvis::scene
