#include "scene/gltf_writer.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "base/files.h"
#include "base/image_io.h"
#include "base/parallel.h"

namespace parvis::scene {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

constexpr int float_type = 5126, unsigned_type = 5125;
constexpr int vertex_target = 34962, index_target = 34963;

Json array_of(glm::vec3 v) { return {v.x, v.y, v.z}; }

/// Collects the binary chunk and the accessors into it.
struct Binary {
  std::vector<std::uint8_t> bytes{};
  Json views = Json::array(), accessors = Json::array();

  template <class T>
  int add(const std::vector<T>& values, const char* type, int component_type, int target) {
    while (bytes.size() % 4 != 0) bytes.push_back(0);
    const std::size_t offset = bytes.size(), length = values.size() * sizeof(T);
    bytes.resize(offset + length);
    std::memcpy(bytes.data() + offset, values.data(), length);
    Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", length}};
    if (target != 0) view["target"] = target;
    views.push_back(view);
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", component_type},
                         {"count", values.size()},
                         {"type", type}});
    return int(accessors.size()) - 1;
  }

  int add_positions(const std::vector<glm::vec3>& positions) {
    const int accessor = add(positions, "VEC3", float_type, vertex_target);
    Bounds bounds;
    for (const glm::vec3& p : positions) bounds.add(p);
    accessors.back()["min"] = array_of(bounds.min);
    accessors.back()["max"] = array_of(bounds.max);
    return accessor;
  }
};

bool uses_alpha(const Image8& image) {
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    if (image.pixels[i] != 255) return true;
  return false;
}

/// Colour without alpha is stored as JPEG; data and alpha as PNG, which loses nothing.
std::string picture_name(const fs::path& file, const Texture& texture, std::size_t index) {
  const std::string name =
      texture.name.empty() ? fmt::format("{}", index) : fs::path(texture.name).stem().string();
  const bool as_jpeg = texture.is_srgb && !uses_alpha(texture.image);
  return fmt::format("{}_{}.{}", file.stem().string(), name, as_jpeg ? "jpg" : "png");
}

Image8 without_alpha(const Image8& image) {
  Image8 colour(image.width, image.height, 3);
  for (std::size_t i = 0; i < image.pixels.size() / 4; ++i)
    for (std::size_t c = 0; c < 3; ++c) colour.pixels[3 * i + c] = image.pixels[4 * i + c];
  return colour;
}

Status write_pictures(const fs::path& file, const Model& model, const std::vector<std::string>& names) {
  Errors errors;
  std::mutex mutex;
  parallel_for(names.size(), [&](std::size_t i) {
    const Image8& image = model.textures[i].image;
    const Status status =
        write_image(file.parent_path() / names[i], uses_alpha(image) ? image : without_alpha(image));
    if (status) return;
    const std::scoped_lock lock(mutex);
    errors.insert(errors.end(), status.errors().begin(), status.errors().end());
  });
  if (!errors.empty()) return errors;
  return Done{};
}

void use(Json& used, const char* extension) {
  if (std::find(used.begin(), used.end(), extension) == used.end()) used.push_back(extension);
}

Json texture_info(int texture, const Material& material, Json& used) {
  Json info{{"index", texture}};
  const glm::mat3& m = material.texture_from_mesh_uv;
  if (m == glm::mat3(1.0f)) return info;
  use(used, "KHR_texture_transform");
  const float scale_u = glm::length(glm::vec2(m[0])), scale_v = glm::length(glm::vec2(m[1]));
  info["extensions"]["KHR_texture_transform"] = {
      {"offset", {m[2].x, m[2].y}}, {"rotation", std::atan2(-m[0].y, m[0].x)}, {"scale", {scale_u, scale_v}}};
  return info;
}

Json material_json(const Material& material, Json& used) {
  Json json{{"name", material.name}};
  Json& metal = json["pbrMetallicRoughness"];
  const glm::vec3 base = glm::clamp(material.base_colour, glm::vec3(0.0f), glm::vec3(1.0f));
  metal["baseColorFactor"] = {base.x, base.y, base.z, material.alpha};
  metal["metallicFactor"] = material.metallic;
  metal["roughnessFactor"] = material.roughness;
  if (material.base_colour_texture != no_index)
    metal["baseColorTexture"] = texture_info(material.base_colour_texture, material, used);
  if (material.surface_texture != no_index)
    metal["metallicRoughnessTexture"] = texture_info(material.surface_texture, material, used);
  if (material.normal_texture != no_index) {
    json["normalTexture"] = texture_info(material.normal_texture, material, used);
    json["normalTexture"]["scale"] = material.normal_scale;
  }
  if (material.emission_texture != no_index)
    json["emissiveTexture"] = texture_info(material.emission_texture, material, used);
  const float strength = std::max({material.emission.x, material.emission.y, material.emission.z, 1.0f});
  if (material.emission != glm::vec3(0.0f)) {
    json["emissiveFactor"] = array_of(material.emission / strength);
    if (strength > 1.0f) {
      use(used, "KHR_materials_emissive_strength");
      json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
    }
  }
  if (material.clear_coat > 0.0f) {
    use(used, "KHR_materials_clearcoat");
    json["extensions"]["KHR_materials_clearcoat"] = {
        {"clearcoatFactor", material.clear_coat},
        {"clearcoatRoughnessFactor", material.clear_coat_roughness}};
  }
  if (material.alpha_mode == Alpha::cutout) json["alphaMode"] = "MASK";
  if (material.alpha_mode == Alpha::blend) json["alphaMode"] = "BLEND";
  if (material.is_double_sided) json["doubleSided"] = true;
  if (material.is_mirror_like) json["extras"]["parvis"]["mirror_like"] = true;
  if (material.translucency > 0.0f) json["extras"]["parvis"]["translucency"] = material.translucency;
  return json;
}

Json node_json(const ModelNode& node) {
  Json json;
  if (!node.name.empty()) json["name"] = node.name;
  if (node.translation != glm::vec3(0.0f)) json["translation"] = array_of(node.translation);
  if (node.scale != glm::vec3(1.0f)) json["scale"] = array_of(node.scale);
  if (node.rotation != glm::quat(1, 0, 0, 0))
    json["rotation"] = {node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w};
  return json.is_null() ? Json::object() : json;
}

/// The nodes of the model, shifted by one below the node that turns z up to y up.
Json nodes_json(const Model& model, const std::vector<int>& mesh_of_node) {
  Json nodes = Json::array();
  const float half = std::sqrt(0.5f);
  nodes.push_back({{"name", "z_up"}, {"rotation", {-half, 0.0f, 0.0f, half}}});
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    nodes.push_back(node_json(model.nodes[i]));
    if (mesh_of_node[i] != no_index) nodes.back()["mesh"] = mesh_of_node[i];
    const int parent = model.nodes[i].parent + 1;
    nodes[std::size_t(parent)]["children"].push_back(i + 1);
  }
  return nodes;
}

Json meshes_json(const Model& model, Binary& binary, std::vector<int>& mesh_of_node) {
  Json meshes = Json::array();
  mesh_of_node.assign(model.nodes.size(), no_index);
  for (const Part& part : model.parts) {
    int& mesh = mesh_of_node[std::size_t(part.node)];
    if (mesh == no_index) {
      mesh = int(meshes.size());
      meshes.push_back({{"name", part.object}, {"primitives", Json::array()}});
    }
    Json primitive{{"attributes",
                    {{"POSITION", binary.add_positions(part.mesh.positions)},
                     {"NORMAL", binary.add(part.mesh.normals, "VEC3", float_type, vertex_target)},
                     {"TEXCOORD_0", binary.add(part.mesh.uvs, "VEC2", float_type, vertex_target)}}},
                   {"indices", binary.add(part.mesh.indices, "SCALAR", unsigned_type, index_target)},
                   {"material", part.material},
                   {"extras", {{"object", part.object}}}};
    if (!part.casts_shadow) primitive["extras"]["casts_shadow"] = false;
    meshes[std::size_t(mesh)]["primitives"].push_back(primitive);
  }
  return meshes;
}

Json animations_json(const Model& model, Binary& binary) {
  using Property = AnimationChannel::Property;
  Json animations = Json::array();
  for (const Animation& animation : model.animations) {
    Json json{{"channels", Json::array()}, {"samplers", Json::array()}};
    if (!animation.name.empty()) json["name"] = animation.name;
    for (const AnimationChannel& channel : animation.channels) {
      const bool is_rotation = channel.property == Property::rotation;
      std::vector<float> values;
      for (const glm::vec4& value : channel.values)
        for (int c = 0; c < (is_rotation ? 4 : 3); ++c) values.push_back(value[c]);
      const int input = binary.add(channel.times_s, "SCALAR", float_type, 0);
      binary.accessors.back()["min"] = {channel.times_s.front()};
      binary.accessors.back()["max"] = {channel.times_s.back()};
      const int output = binary.add(values, is_rotation ? "VEC4" : "VEC3", float_type, 0);
      binary.accessors.back()["count"] = channel.values.size();
      const char* interpolation = channel.interpolation == Interpolation::step    ? "STEP"
                                  : channel.interpolation == Interpolation::cubic ? "CUBICSPLINE"
                                                                                  : "LINEAR";
      json["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
      const char* path = is_rotation                           ? "rotation"
                         : channel.property == Property::scale ? "scale"
                                                               : "translation";
      json["channels"].push_back({{"sampler", json["samplers"].size() - 1},
                                  {"target", {{"node", channel.node + 1}, {"path", path}}}});
    }
    animations.push_back(json);
  }
  return animations;
}

void append_word(std::string& bytes, std::size_t value) {
  const std::uint32_t word = std::uint32_t(value);
  bytes.append(reinterpret_cast<const char*>(&word), 4);
}

std::string container(const Json& json, std::vector<std::uint8_t> binary) {
  std::string text = json.dump();
  while (text.size() % 4 != 0) text += ' ';
  while (binary.size() % 4 != 0) binary.push_back(0);
  std::string bytes = "glTF";
  append_word(bytes, 2);
  append_word(bytes, 12 + 8 + text.size() + 8 + binary.size());
  append_word(bytes, text.size());
  bytes += "JSON" + text;
  append_word(bytes, binary.size());
  bytes.append("BIN\0", 4);
  bytes.append(binary.begin(), binary.end());
  return bytes;
}

}  // namespace

Status write_gltf(const fs::path& file, const Model& model) {
  std::vector<std::string> names;
  names.reserve(model.textures.size());
  for (std::size_t i = 0; i < model.textures.size(); ++i)
    names.push_back(picture_name(file, model.textures[i], i));
  if (Status status = write_pictures(file, model, names); !status) return status;

  Json json{
      {"asset", {{"version", "2.0"}, {"generator", "Parvis"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0}}}}}};
  Json used = Json::array();
  for (const Material& material : model.materials) json["materials"].push_back(material_json(material, used));
  for (std::size_t i = 0; i < names.size(); ++i) {
    json["images"].push_back({{"uri", names[i]}});
    json["textures"].push_back({{"source", i}, {"sampler", model.textures[i].repeats ? 0 : 1}});
  }
  constexpr int linear = 9729, trilinear = 9987, repeat = 10497, clamp = 33071;
  if (!names.empty())
    for (const int wrap : {repeat, clamp})
      json["samplers"].push_back(
          {{"magFilter", linear}, {"minFilter", trilinear}, {"wrapS", wrap}, {"wrapT", wrap}});

  Binary binary;
  std::vector<int> mesh_of_node;
  json["meshes"] = meshes_json(model, binary, mesh_of_node);
  json["nodes"] = nodes_json(model, mesh_of_node);
  if (!model.animations.empty()) json["animations"] = animations_json(model, binary);
  json["accessors"] = binary.accessors;
  json["bufferViews"] = binary.views;
  json["buffers"] = {{{"byteLength", (binary.bytes.size() + 3) / 4 * 4}}};
  if (!used.empty()) json["extensionsUsed"] = used;
  return write_file(file, container(json, std::move(binary.bytes)));
}

}  // namespace parvis::scene
