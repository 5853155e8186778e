#include "formats/gltf/gltf_meshes.h"

#include <numeric>

#include "formats/gltf/gltf_values.h"

namespace parvis::scene {
namespace {

constexpr int triangles = 4, strip = 5, fan = 6;

std::vector<std::uint32_t> triangle_list(const std::vector<std::uint32_t>& order, int mode) {
  if (mode == triangles) return order;
  std::vector<std::uint32_t> list;
  for (std::size_t i = 0; i + 2 < order.size(); ++i) {
    if (mode == strip)  // every second triangle is wound the other way
      list.insert(list.end(), {order[i + i % 2], order[i + 1 - i % 2], order[i + 2]});
    else
      list.insert(list.end(), {order[0], order[i + 1], order[i + 2]});
  }
  return list;
}

}  // namespace

Mesh read_primitive(const GltfFile& file, const GltfFile::Json& primitive, const std::string& mesh_name) {
  const int mode = primitive.value("mode", triangles);
  if (mode != triangles && mode != strip && mode != fan) return {};
  const GltfFile::Json& attributes = gltf_member(primitive, "attributes");
  Mesh mesh;
  mesh.positions = gltf_attribute<3>(file, attributes, "POSITION");
  mesh.normals = gltf_attribute<3>(file, attributes, "NORMAL");
  mesh.uvs = gltf_attribute<2>(file, attributes, "TEXCOORD_0");
  const std::size_t count = mesh.positions.size();
  if (mesh.uvs.empty()) mesh.uvs.resize(count, glm::vec2(0.0f));
  if (mesh.normals.empty()) mesh.normals.resize(count, glm::vec3(0.0f));
  std::vector<std::uint32_t> order;
  if (const int accessor = file.index(primitive, "indices", "accessors"); accessor >= 0) {
    order = file.integers(accessor);
  } else {
    order.resize(count);
    std::iota(order.begin(), order.end(), 0u);
  }
  mesh.indices = triangle_list(order, mode);
  if (const Status status = check(mesh, "mesh \"" + mesh_name + "\""); !status)
    gltf_fail("{}", status.errors().front().message);
  fill_normals(mesh);
  for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
  return mesh;
}

}  // namespace parvis::scene
