#include "formats/gltf/gltf_meshes.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <span>

#include "formats/gltf/gltf_values.h"

namespace parvis::scene {
namespace {

constexpr int triangles = 4, strip = 5, fan = 6;

/// Adds the triangles of one run of strips or fans.
void add_triangles(std::span<const std::uint32_t> order, int mode, std::vector<std::uint32_t>& list) {
  for (std::size_t i = 0; i + 2 < order.size(); ++i) {
    if (mode == strip)  // every second triangle is wound the other way
      list.insert(list.end(), {order[i + i % 2], order[i + 1 - i % 2], order[i + 2]});
    else
      list.insert(list.end(), {order[0], order[i + 1], order[i + 2]});
  }
}

/// `restart`: the index that ends one run and begins another (KHR_mesh_primitive_restart).
std::vector<std::uint32_t> triangle_list(const std::vector<std::uint32_t>& order, int mode,
                                         std::optional<std::uint32_t> restart) {
  if (mode == triangles) return order;
  std::vector<std::uint32_t> list;
  for (auto begin = order.begin(); begin <= order.end();) {
    const auto end = restart ? std::find(begin, order.end(), *restart) : order.end();
    add_triangles({begin, end}, mode, list);
    if (end == order.end()) break;
    begin = end + 1;
  }
  return list;
}

/// The greatest value of the indices' type, which no vertex may have.
std::optional<std::uint32_t> restart_of(const GltfFile& file, int accessor) {
  const auto& used = file.list("extensionsUsed");
  if (std::ranges::find(used, GltfFile::Json("KHR_mesh_primitive_restart")) == used.end())
    return std::nullopt;
  switch (file.list("accessors")[std::size_t(accessor)].value("componentType", 5125)) {
    case 5121:
      return 0xffu;
    case 5123:
      return 0xffffu;
    default:
      return 0xffffffffu;
  }
}

/// COLOR_0 with three or four components, linear; none where there is none.
std::vector<glm::vec4> read_colours(const GltfFile& file, const GltfFile::Json& attributes) {
  const int accessor = file.index(attributes, "COLOR_0", "accessors");
  if (accessor < 0) return {};
  if (file.list("accessors")[std::size_t(accessor)].value("type", "") == "VEC4")
    return gltf_attribute<4>(file, attributes, "COLOR_0");
  std::vector<glm::vec4> colours;
  for (const glm::vec3 colour : gltf_attribute<3>(file, attributes, "COLOR_0"))
    colours.emplace_back(colour, 1.0f);
  return colours;
}

std::string texcoord(int set) { return fmt::format("TEXCOORD_{}", set); }

/// Counts the fate of an attribute that is neither a position nor a normal.
void count_attribute(const std::string& name, UvSets sets, bool is_skinned, FileAccount& account) {
  if (name.starts_with("TEXCOORD_"))
    return account.unneeded("texture coordinates", "no texture takes them", name,
                            name != texcoord(sets.first) && name != texcoord(sets.second));
  if (name == "TANGENT")
    return account.unneeded("vertex attributes", "tangents follow from the texture", name);
  if (name == "JOINTS_0" || name == "WEIGHTS_0")
    return account.unneeded("vertex attributes", "no skin takes them", name, is_skinned ? 0 : 1);
  if (name == "POSITION" || name == "NORMAL" || name == "COLOR_0") return;
  account.left_out("vertex attributes", "nothing reads them", name);
}

}  // namespace

Mesh read_primitive(const GltfFile& file, const GltfFile::Json& primitive, const std::string& mesh_name,
                    UvSets sets) {
  const int mode = primitive.value("mode", triangles);
  if (mode != triangles && mode != strip && mode != fan) return {};
  const GltfFile::Json& attributes = gltf_member(primitive, "attributes");
  if (!attributes.contains("POSITION")) return {};
  Mesh mesh;
  mesh.positions = gltf_attribute<3>(file, attributes, "POSITION");
  mesh.normals = gltf_attribute<3>(file, attributes, "NORMAL");
  mesh.uvs = gltf_attribute<2>(file, attributes, texcoord(sets.first).c_str());
  if (sets.second >= 0) mesh.second_uvs = gltf_attribute<2>(file, attributes, texcoord(sets.second).c_str());
  mesh.colours = read_colours(file, attributes);
  const std::size_t count = mesh.positions.size();
  if (mesh.uvs.empty()) mesh.uvs.resize(count, glm::vec2(0.0f));
  if (mesh.normals.empty()) mesh.normals.resize(count, glm::vec3(0.0f));
  std::vector<std::uint32_t> order;
  std::optional<std::uint32_t> restart;
  if (const int accessor = file.index(primitive, "indices", "accessors"); accessor >= 0) {
    order = file.integers(accessor);
    restart = restart_of(file, accessor);
  } else {
    order.resize(count);
    std::iota(order.begin(), order.end(), 0u);
  }
  mesh.indices = triangle_list(order, mode, restart);
  if (const Status status = check(mesh, "mesh \"" + mesh_name + "\""); !status)
    gltf_fail("{}", status.errors().front().message);
  fill_normals(mesh);
  for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
  return mesh;
}

void count_primitives(const GltfFile& file, const GltfFile::Json& mesh, const std::vector<UvSets>& sets,
                      FileAccount& account) {
  const std::string name = mesh.value("name", "");
  for (const GltfFile::Json& primitive : mesh.value("primitives", GltfFile::Json::array())) {
    const int mode = primitive.value("mode", triangles);
    if (mode != triangles && mode != strip && mode != fan) {
      account.left_out("primitives", "points and lines have no surface", name);
      continue;
    }
    if (!gltf_member(primitive, "attributes").contains("POSITION")) {
      account.left_out("primitives", "they have no positions", name);
      continue;
    }
    account.used("primitives");
    const int material = file.index(primitive, "material", "materials");
    const GltfFile::Json& attributes = gltf_member(primitive, "attributes");
    for (const auto& [attribute, accessor] : attributes.items())
      count_attribute(attribute, material < 0 ? UvSets{-1, -1} : sets[std::size_t(material)],
                      !file.list("skins").empty(), account);
    for (const GltfFile::Json& target : gltf_targets(primitive))
      for (const auto& [attribute, accessor] : target.items())
        if (attribute != "POSITION" && attribute != "NORMAL" && attribute != "TANGENT")
          account.left_out("attributes of morph targets", "positions and normals are morphed", attribute);
  }
}

}  // namespace parvis::scene
