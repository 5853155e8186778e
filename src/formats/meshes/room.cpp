#include "base/registries.h"
#include "formats/meshes/mesh_formats.h"
#include "formats/meshes/mesh_nodes.h"
#include "room_list.h"

namespace parvis::meshes {

/// Adds model, object, material, wheels; the reader of every file that no other room reads.
void register_room(Registries& registries) {
  scene::NodeRegistry& registry = registries.get<scene::NodeRegistry>();
  formats::Readers& readers = registries.get<formats::Readers>();
  scene::add_model_node(registry, readers);
  scene::add_object_node(registry, readers);
  scene::add_material_nodes(registry);
  scene::add_wheel_nodes(registry);
  registry.allow(scene::include_type, "model");
  scene::add_mesh_formats(readers);
}

}  // namespace parvis::meshes
