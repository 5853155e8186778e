#include "formats/meshes/mesh_nodes.h"

#include "formats/meshes/assimp_reader.h"

namespace parvis::scene {

void furnish_meshes(House& house) {
  NodeRegistry& registry = house.get<NodeRegistry>();
  formats::Readers& readers = house.get<formats::Readers>();
  add_model_node(registry, readers);
  add_material_nodes(registry);
  add_wheel_nodes(registry);
  registry.allow(include_type, "model");
  readers.set_fallback([](const std::filesystem::path& file, const formats::ModelReading& reading,
                          Errors& warnings) { return read_with_assimp(file, reading.up, warnings); });
}

}  // namespace parvis::scene
