#include "formats/gltf/gltf_writer.h"

#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "base/partial_file.h"
#include "formats/gltf/gltf_animation_writer.h"
#include "formats/gltf/gltf_cameras.h"
#include "formats/gltf/gltf_chunk.h"
#include "formats/gltf/gltf_material_writer.h"
#include "formats/gltf/gltf_mesh_writer.h"
#include "formats/gltf/gltf_own_data.h"
#include "formats/gltf/gltf_packing.h"
#include "formats/gltf/gltf_transform.h"

namespace parvis::scene {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

Json array_of(glm::dvec3 v) { return {v.x, v.y, v.z}; }

Json node_json(const ModelNode& node) {
  Json json = Json::object();
  if (!node.name.empty()) json["name"] = node.name;
  if (node.translation != glm::dvec3(0.0)) json["translation"] = array_of(node.translation);
  if (node.scale != glm::dvec3(1.0)) json["scale"] = array_of(node.scale);
  if (node.rotation != glm::dquat(1, 0, 0, 0))
    json["rotation"] = {node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w};
  return json;
}

/// A node that stands in its parent as the matrix says.
ModelNode node_of(const std::string& name, int parent, const glm::dmat4& parent_from_node) {
  ModelNode node{.name = name, .parent = parent};
  decompose(parent_from_node, node);
  return node;
}

/// The nodes of an object as it is posed; its own if it plays an animation, which then poses it.
std::vector<ModelNode> nodes_now(const Object& object) {
  std::vector<ModelNode> nodes = object.model->nodes;
  if (object.pose.empty() || object.played.animation != no_index) return nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int parent = nodes[i].parent;
    const glm::dmat4 model_from_parent =
        parent == no_index ? glm::dmat4(1.0) : glm::dmat4(object.pose[std::size_t(parent)]);
    nodes[i] = node_of(nodes[i].name, parent, glm::inverse(model_from_parent) * glm::dmat4(object.pose[i]));
  }
  return nodes;
}

void append_word(std::string& bytes, std::size_t value) {
  const auto word = std::uint32_t(value);
  bytes.append(reinterpret_cast<const char*>(&word), 4);
}

void append_chunk(std::string& bytes, const char* type, std::string_view data, char padding) {
  const std::size_t padded = (data.size() + 3) / 4 * 4;
  append_word(bytes, padded);
  bytes.append(type, 4).append(data).append(padded - data.size(), padding);
}

/// The bytes of a .glb. Errors: they are more than one holds; `name` stands in them.
Result<std::string> container_of(const Json& json, std::span<const std::uint8_t> data,
                                 const std::string& name) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string_view binary(reinterpret_cast<const char*>(data.data()), data.size());
  std::string chunks;
  append_chunk(chunks, "JSON", text, ' ');
  if (!binary.empty()) append_chunk(chunks, "BIN\0", binary, '\0');
  const std::size_t size = 12 + chunks.size();
  if (size > std::numeric_limits<std::uint32_t>::max())
    return error("{}: a .glb holds 4 GB; this is {:.1f}: write it in parts", name, double(size) * 1e-9);
  std::string bytes = "glTF";
  append_word(bytes, 2);
  append_word(bytes, size);
  return bytes + chunks;
}

class Writer {
 public:
  /// A writer of objects; `is_still`: their animations are left out.
  explicit Writer(bool is_still = false) : is_still_(is_still) {
    nodes_.push_back({{"name", "z_up"}, {"matrix", gltf_matrix(glm::transpose(z_up_from_y_up()))}});
  }

  /// Adds all of `model`, in `materials`, on nodes of an object, below the file's node `parent`.
  Status add(const Model& model, const std::vector<Material>& materials, const std::vector<ModelNode>& nodes,
             const std::string& name, int parent) {
    Result<const WrittenModel*> shared = written(model, materials);
    if (!shared) return shared.errors();
    const WrittenModel& parts = **shared;
    WrittenObject object{name, int(nodes_.size()), {}};
    for (const ModelNode& node : nodes)
      append(node_json(node), node.parent == no_index ? parent : object.first_node + node.parent);
    for (const WrittenMesh& mesh : parts.meshes) object.node_of_mesh.push_back(hang(mesh, object.first_node));
    for (const WrittenAnimation& animation : parts.animations) {
      const Json json = animation_json(animation, object, parts.meshes);
      if (!json["channels"].empty()) animations_.push_back(json);
    }
    return Ok{};
  }

  Status add(const Object& object) {
    ModelNode upper{.name = object.name}, lower;
    const bool shears = !decompose(glm::dmat4(object.world_from_model), upper);
    if (shears) decompose(glm::dmat4(object.world_from_model), upper, lower);
    int node = append(node_json(upper), 0);
    if (shears) node = append(node_json(lower), node);
    return add(*object.model, object.materials(), nodes_now(object), object.name, node);
  }

  void add(const NamedCamera& camera) {
    append(gltf_camera_node(camera.name, camera.camera, cameras_.size()), 0);
    cameras_.push_back(gltf_camera(camera.name, camera.camera));
  }

  Status add(const GltfOwnData& own) {
    Json json = Json::parse(own.json, nullptr, false);
    if (!json.is_object()) return error("the extension {} is no object of JSON", own.extension);
    for (const auto& [name, bytes] : own.views)
      if (!bytes.empty()) json["views"][name] = chunk_.add_bytes(bytes);  // glTF has no empty views
    extensions_[own.extension] = std::move(json);
    return Ok{};
  }

  Status write(const fs::path& file) const {
    Result<std::vector<PartialFile>> pictures = materials_.write_pictures(file);
    if (!pictures) return pictures.errors();
    return write_container(file, described(file), *pictures);
  }

  Result<PackedGltf> packed(int first_px, int max_px) const {
    const Result<std::vector<std::string>> inside = materials_.browser_pictures(first_px);
    const Result<std::vector<std::string>> sharper = materials_.browser_pictures(max_px, first_px);
    if (!inside) return inside.errors();
    if (!sharper) return sharper.errors();
    Json json = described("place.glb");
    std::vector<std::uint8_t> bytes = chunk_.bytes();
    if (json.contains("meshes")) pack_meshes(json, bytes);
    PackedGltf made;
    bool has_webp = false;
    for (std::size_t i = 0; i < inside->size(); ++i) {
      bytes.resize((bytes.size() + 3) / 4 * 4);
      const std::string& picture = (*inside)[i];
      const bool is_webp = picture.starts_with("RIFF");
      has_webp = has_webp || is_webp;
      json["images"][i] = {{"bufferView", json["bufferViews"].size()},
                           {"mimeType", is_webp ? "image/webp" : "image/png"}};
      json["bufferViews"].push_back(
          {{"buffer", 0}, {"byteOffset", bytes.size()}, {"byteLength", picture.size()}});
      bytes.insert(bytes.end(), picture.begin(), picture.end());
      if (is_webp) {
        Json& texture = json["textures"][i];
        texture["extensions"]["EXT_texture_webp"]["source"] = texture["source"];
        texture.erase("source");
      }
      if (!(*sharper)[i].empty()) made.sharper.emplace_back(int(i), (*sharper)[i]);
    }
    if (has_webp)
      for (const char* list : {"extensionsUsed", "extensionsRequired"})
        json[list].push_back("EXT_texture_webp");
    json["buffers"][0]["byteLength"] = bytes.size();
    Result<std::string> container = container_of(json, bytes, "a packed .glb");
    if (!container) return container.errors();
    made.glb = *std::move(container);
    return made;
  }

 private:
  /// The JSON of the file, whose pictures lie beside it.
  Json described(const fs::path& file) const {
    Json json{{"asset", {{"version", "2.0"}, {"generator", "Parvis"}}},
              {"scene", 0},
              {"scenes", {{{"nodes", {0}}}}},
              {"nodes", nodes_}};
    for (const auto& [name, list] : {std::pair{"meshes", &meshes_}, std::pair{"skins", &skins_},
                                     std::pair{"animations", &animations_}, std::pair{"cameras", &cameras_}})
      if (!list->empty()) json[name] = *list;
    materials_.describe(json, file);
    chunk_.describe(json);
    if (!extensions_.empty()) json["extensions"] = extensions_;
    for (const auto& [name, own] : extensions_.items()) json["extensionsUsed"].push_back(name);
    return json;
  }

  /// Data shared by objects of one model and paint.
  struct WrittenModel {
    int first_material;
    std::vector<WrittenMesh> meshes;
    std::vector<WrittenAnimation> animations;
  };

  Result<const WrittenModel*> written(const Model& model, const std::vector<Material>& materials) {
    if (const auto found = models_.find({&model, &materials}); found != models_.end()) return &found->second;
    const auto other = models_.lower_bound({&model, nullptr});
    if (other != models_.end() && other->first.first == &model)
      return &models_.emplace(std::pair(&model, &materials), painted(other->second, model, materials))
                  .first->second;
    const int first_material = materials_.add(model, materials);
    Result<std::vector<WrittenMesh>> meshes = write_meshes(model, first_material, chunk_, meshes_);
    if (!meshes) return meshes.errors();
    return &models_
                .emplace(std::pair(&model, &materials),
                         WrittenModel{
                             first_material, *std::move(meshes),
                             is_still_ ? std::vector<WrittenAnimation>() : write_keyframes(model, chunk_)})
                .first->second;
  }

  /// The same meshes over the same data, in other materials.
  WrittenModel painted(WrittenModel written, const Model& model, const std::vector<Material>& materials) {
    const int first_material = materials_.add(model, materials);
    for (WrittenMesh& mesh : written.meshes) {
      Json copy = meshes_[std::size_t(mesh.mesh)];
      for (Json& primitive : copy["primitives"])
        primitive["material"] = primitive["material"].get<int>() - written.first_material + first_material;
      mesh.mesh = int(meshes_.size());
      meshes_.push_back(std::move(copy));
    }
    written.first_material = first_material;
    return written;
  }

  int append(Json node, int parent) {
    nodes_.push_back(std::move(node));
    nodes_[std::size_t(parent)]["children"].push_back(nodes_.size() - 1);
    return int(nodes_.size()) - 1;
  }

  /// Hangs a mesh on its node, or below it where another hangs there: glTF has one mesh a node.
  int hang(const WrittenMesh& mesh, int first_node) {
    int node = first_node + mesh.node;
    if (nodes_[std::size_t(node)].contains("mesh")) node = append(Json::object(), node);
    nodes_[std::size_t(node)]["mesh"] = mesh.mesh;
    if (mesh.inverse_bind == no_index) return node;
    Json skin{{"inverseBindMatrices", mesh.inverse_bind}, {"joints", Json::array()}};
    for (const int joint : mesh.deformation->skin.joints) skin["joints"].push_back(first_node + joint);
    nodes_[std::size_t(node)]["skin"] = skins_.size();
    skins_.push_back(skin);
    return node;
  }

  Status write_container(const fs::path& file, const Json& json, std::vector<PartialFile>& pictures) const;

  bool is_still_;
  GltfMaterialWriter materials_;
  GltfChunk chunk_;
  std::map<std::pair<const Model*, const std::vector<Material>*>, WrittenModel> models_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), skins_ = Json::array(), animations_ = Json::array(),
       cameras_ = Json::array(), extensions_ = Json::object();
};

/// Pictures and file take their places together, when all of them are on the disk: none does where one
/// cannot be written.
Status Writer::write_container(const fs::path& file, const Json& json,
                               std::vector<PartialFile>& pictures) const {
  const Result<std::string> bytes = container_of(json, chunk_.bytes(), file.string());
  if (!bytes) return bytes.errors();
  Result<PartialFile> container = PartialFile::create(file);
  if (!container) return container.errors();
  if (Status status = container->write(*bytes); !status) return status;
  if (Status status = container->sync(); !status) return status;
  for (const PartialFile& picture : pictures)
    if (Status status = picture.sync(); !status) return status;
  for (PartialFile& picture : pictures)
    if (Status status = picture.keep(); !status) return status;
  return container->keep();
}

}  // namespace

Status write_gltf(const fs::path& file, const Model& model) {
  Writer writer;
  if (Status status = writer.add(model, model.materials, model.nodes, "", 0); !status) return status;
  return writer.write(file);
}

Status write_gltf(const fs::path& file, const Model& model, const GltfOwnData& own) {
  Writer writer;
  if (Status status = writer.add(model, model.materials, model.nodes, "", 0); !status) return status;
  if (Status status = writer.add(own); !status) return status;
  return writer.write(file);
}

Status write_gltf(const fs::path& file, std::span<const Object* const> objects,
                  std::span<const NamedCamera> cameras) {
  Writer writer;
  for (const Object* object : objects)
    if (Status status = writer.add(*object); !status) return status;
  for (const NamedCamera& camera : cameras) writer.add(camera);
  return writer.write(file);
}

Result<PackedGltf> packed_gltf(std::span<const Object* const> objects, int first_px, int max_px) {
  Writer writer(true);
  for (const Object* object : objects)
    if (Status status = writer.add(*object); !status) return status.errors();
  return writer.packed(first_px, max_px);
}

}  // namespace parvis::scene
