#include "capture/facades/coarse_model_file.h"

#include <filesystem>

#include "formats/gltf/gltf_writer.h"

namespace parvis::facades {

Status write_meshes(const std::filesystem::path& file, const std::vector<NamedMesh>& meshes) {
  scene::Model out;
  out.name = file.stem().string();
  scene::Material grey;
  grey.name = "unpainted";
  grey.base_colour = glm::vec3(0.6f);
  grey.is_double_sided = true;
  out.materials.push_back(grey);
  for (const NamedMesh& named : meshes) {
    scene::ModelNode node;
    node.name = named.name;
    node.parent = 0;
    scene::Part part;
    part.object = named.name;
    part.mesh = named.mesh;
    part.node = int(out.nodes.size());
    out.nodes.push_back(std::move(node));
    out.parts.push_back(std::move(part));
  }
  return scene::write_gltf(file, out);
}

}  // namespace parvis::facades
