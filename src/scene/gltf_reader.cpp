#include "scene/gltf_reader.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/matrix_decompose.hpp>
#include <map>
#include <mutex>

#include "base/image_io.h"
#include "base/parallel.h"
#include "scene/gltf_file.h"
#include "scene/gltf_skin.h"
#include "scene/placeholder.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;
using Problem = GltfFile::GltfProblem;

template <class... Args>
[[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) {
  throw Problem{fmt::format(format, std::forward<Args>(args)...)};
}

float number(const Json& object, const char* name, float otherwise) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? found->get<float>() : otherwise;
}

template <int N>
glm::vec<N, float> vector(const Json& object, const char* name, glm::vec<N, float> otherwise) {
  const auto found = object.find(name);
  if (found == object.end()) return otherwise;
  if (!found->is_array() || found->size() != std::size_t(N))
    fail("\"{}\" is {}; expected {} numbers", name, found->dump(), N);
  for (int i = 0; i < N; ++i) otherwise[i] = (*found)[std::size_t(i)].get<float>();
  return otherwise;
}

const Json& member(const Json& object, const char* name) {
  static const Json nothing = Json::object();
  const auto found = object.find(name);
  return found != object.end() && found->is_object() ? *found : nothing;
}

const Json& extension(const Json& object, const char* name) {
  return member(member(object, "extensions"), name);
}

/// Reads one file into one model.
class Reader {
 public:
  Reader(const std::filesystem::path& file, Errors& warnings) : file_(file), warnings_(warnings) {}

  Model read() {
    model_.name = file_.path().stem().string();
    read_materials();
    read_nodes();
    bend_skinned_parts();
    read_animations();
    read_pictures();
    if (model_.parts.empty()) fail("no triangles are in this model");
    return std::move(model_);
  }

 private:
  // --- materials
  // -----------------------------------------------------------------------------------------------------

  /// The model's texture for a textureInfo: one for each pair of glTF texture and colour space.
  int texture(const Json& info, bool is_srgb, Material& material) {
    const int gltf_texture = file_.index(info, "index", "textures");
    if (gltf_texture < 0) return no_index;
    const Json& transform = extension(info, "KHR_texture_transform");
    if (!transform.empty()) material.texture_from_mesh_uv = texture_transform(transform);
    const auto [place, is_new] = textures_.try_emplace({gltf_texture, is_srgb}, int(model_.textures.size()));
    if (!is_new) return place->second;
    const Json& description = file_.list("textures")[std::size_t(gltf_texture)];
    const int sampler = file_.index(description, "sampler", "samplers");
    constexpr int clamp_to_edge = 33071;
    const bool repeats =
        sampler < 0 || file_.list("samplers")[std::size_t(sampler)].value("wrapS", 10497) != clamp_to_edge;
    model_.textures.push_back({"", {}, is_srgb, repeats});
    images_.push_back(file_.index(description, "source", "images"));
    return place->second;
  }

  static glm::mat3 texture_transform(const Json& transform) {
    const glm::vec2 offset = vector<2>(transform, "offset", glm::vec2(0.0f));
    const glm::vec2 scale = vector<2>(transform, "scale", glm::vec2(1.0f));
    const float angle = number(transform, "rotation", 0.0f), c = std::cos(angle), s = std::sin(angle);
    // KHR_texture_transform: translation * rotation * scale, counter-clockwise with v downward
    return glm::mat3(1, 0, 0, 0, 1, 0, offset.x, offset.y, 1) * glm::mat3(c, -s, 0, s, c, 0, 0, 0, 1) *
           glm::mat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, 1);
  }

  Material material(const Json& source) {
    Material m;
    m.name = source.value("name", "");
    const Json& metal = member(source, "pbrMetallicRoughness");
    const glm::vec4 base = vector<4>(metal, "baseColorFactor", glm::vec4(1.0f));
    m.base_colour = glm::vec3(base);
    m.alpha = base.w;
    m.metallic = number(metal, "metallicFactor", 1.0f);
    m.roughness = number(metal, "roughnessFactor", 1.0f);
    m.base_colour_texture = texture(member(metal, "baseColorTexture"), true, m);
    m.surface_texture = texture(member(metal, "metallicRoughnessTexture"), false, m);
    m.normal_texture = texture(member(source, "normalTexture"), false, m);
    m.normal_scale = number(member(source, "normalTexture"), "scale", 1.0f);
    m.emission_texture = texture(member(source, "emissiveTexture"), true, m);
    m.emission = vector<3>(source, "emissiveFactor", glm::vec3(0.0f)) *
                 number(extension(source, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0f);
    const Json& coat = extension(source, "KHR_materials_clearcoat");
    m.clear_coat = number(coat, "clearcoatFactor", 0.0f);
    m.clear_coat_roughness = number(coat, "clearcoatRoughnessFactor", 0.0f);
    const std::string mode = source.value("alphaMode", "OPAQUE");
    m.alpha_mode = mode == "MASK" ? Alpha::cutout : mode == "BLEND" ? Alpha::blend : Alpha::opaque;
    m.is_double_sided = source.value("doubleSided", false);
    const Json& parvis = member(member(source, "extras"), "parvis");
    m.translucency = number(parvis, "translucency", 0.0f);
    m.is_mirror_like = parvis.value("mirror_like", false);
    if (number(extension(source, "KHR_materials_transmission"), "transmissionFactor", 0.0f) > 0.5f) {
      m.base_colour *= 0.1f;  // panes are shown dark and mirroring, as they look by day
      m.is_mirror_like = true;
    }
    return m;
  }

  void read_materials() {
    for (const Json& source : file_.list("materials")) model_.materials.push_back(material(source));
    default_material_ = int(model_.materials.size());
    Material plain;
    plain.name = "default";
    model_.materials.push_back(plain);
  }

  void read_pictures() {
    std::mutex mutex;
    parallel_for(model_.textures.size(), [&](std::size_t i) {
      Texture& texture = model_.textures[i];
      Result<Image8> picture = read_picture(images_[i], texture.name);
      if (picture) {
        texture.image = *std::move(picture);
        return;
      }
      texture.image = placeholder_picture();
      const std::scoped_lock lock(mutex);
      for (const Error& problem : picture.errors())
        warnings_.push_back({problem.message + "; a checker stands for it", {file_.path().string(), 0, 0}});
    });
  }

  Result<Image8> read_picture(int image, std::string& name) const {
    if (image < 0) return error("a texture without a picture");
    const Json& description = file_.list("images")[std::size_t(image)];
    name = description.value("uri", description.value("name", fmt::format("image {}", image)));
    if (name.starts_with("data:")) name = fmt::format("image {}", image);
    try {
      if (const int view = file_.index(description, "bufferView", "bufferViews"); view >= 0)
        return read_image8(file_.buffer_view(view), name);
      const std::vector<std::uint8_t> bytes = file_.resource(description.value("uri", ""));
      return read_image8(bytes, name);
    } catch (const Problem& problem) {
      return error("{}", problem.message);
    } catch (const Json::exception& problem) {
      return error("{}: {}", name, problem.what());
    }
  }

  // --- nodes and meshes
  // ----------------------------------------------------------------------------------------------

  void read_nodes() {
    model_.nodes.front().name = "y_up";
    model_.nodes.front().rotation = glm::angleAxis(glm::radians(90.0f), glm::vec3(1, 0, 0));
    node_of_gltf_.assign(file_.list("nodes").size(), no_index);
    const Json& scenes = file_.list("scenes");
    if (scenes.empty()) {
      for (std::size_t i = 0; i < file_.list("nodes").size(); ++i)
        if (node_of_gltf_[i] == no_index && !is_child(i)) read_tree(i);
      return;
    }
    const int scene = std::max(file_.index(file_.json(), "scene", "scenes"), 0);
    for (const Json& root : scenes[std::size_t(scene)].value("nodes", Json::array()))
      read_tree(node_index(root));
  }

  bool is_child(std::size_t node) const {
    for (const Json& other : file_.list("nodes"))
      for (const Json& child : other.value("children", Json::array()))
        if (child == node) return true;
    return false;
  }

  std::size_t node_index(const Json& value) const {
    if (!value.is_number_unsigned() || value.get<std::size_t>() >= node_of_gltf_.size())
      fail("node {} is out of range; there are {}", value.dump(), node_of_gltf_.size());
    return value.get<std::size_t>();
  }

  /// A node and all below it, without recursion: a hostile tree may be deep.
  void read_tree(std::size_t root) {
    std::vector<std::pair<std::size_t, int>> open{{root, 0}};
    while (!open.empty()) {
      const auto [gltf_node, parent] = open.back();
      open.pop_back();
      if (node_of_gltf_[gltf_node] != no_index)
        fail("node {} has two parents or is its own ancestor; glTF asks for a tree", gltf_node);
      const int node = int(model_.nodes.size());
      node_of_gltf_[gltf_node] = node;
      const Json& source = file_.list("nodes")[gltf_node];
      model_.nodes.push_back(read_node(source, parent));
      if (const int mesh = file_.index(source, "mesh", "meshes"); mesh >= 0) read_mesh(mesh, node, source);
      for (const Json& child : source.value("children", Json::array()))
        open.emplace_back(node_index(child), node);
    }
  }

  static ModelNode read_node(const Json& source, int parent) {
    ModelNode node;
    node.name = source.value("name", "");
    node.parent = parent;
    if (source.contains("matrix")) {
      glm::mat4 matrix(1.0f);
      const Json& values = source["matrix"];
      if (!values.is_array() || values.size() != 16)
        fail("a node's matrix has {} numbers; expected 16", values.size());
      for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = values[std::size_t(i)].get<float>();
      glm::vec3 skew;
      glm::vec4 perspective;
      if (!glm::decompose(matrix, node.scale, node.rotation, node.translation, skew, perspective))
        fail("a node's matrix is singular: it flattens the model");
    } else {
      node.translation = vector<3>(source, "translation", glm::vec3(0.0f));
      node.scale = vector<3>(source, "scale", glm::vec3(1.0f));
      const glm::vec4 q = vector<4>(source, "rotation", glm::vec4(0, 0, 0, 1));
      const float length = glm::length(q);
      if (length > 0.0f) node.rotation = glm::quat(q.w, q.x, q.y, q.z) / length;
    }
    for (int i = 0; i < 3; ++i)
      if (!std::isfinite(node.translation[i]) || !std::isfinite(node.scale[i]) ||
          !std::isfinite(node.rotation[i]))
        fail("the transform of node \"{}\" is not finite", node.name);
    return node;
  }

  void read_mesh(int mesh, int node, const Json& node_source) {
    const Json& source = file_.list("meshes")[std::size_t(mesh)];
    const std::string name = source.value("name", node_source.value("name", fmt::format("mesh {}", mesh)));
    for (const Json& primitive : source.value("primitives", Json::array())) {
      constexpr int triangles = 4, strip = 5, fan = 6;
      const int mode = primitive.value("mode", triangles);
      if (mode != triangles && mode != strip && mode != fan) continue;  // points and lines have no surface
      Part part;
      part.object = primitive.contains("extras") ? member(primitive, "extras").value("object", name) : name;
      part.node = node;
      const int material = file_.index(primitive, "material", "materials");
      part.material = material < 0 ? default_material_ : material;
      part.casts_shadow = member(primitive, "extras").value("casts_shadow", true);
      part.mesh = read_primitive(primitive, mode, name);
      if (part.mesh.indices.empty()) continue;
      if (const int skin = file_.index(node_source, "skin", "skins"); skin >= 0)
        skinned_.push_back({model_.parts.size(), skin, member(primitive, "attributes")});
      model_.parts.push_back(std::move(part));
    }
  }

  /// Skinned parts stand in the rest pose of their joints, in the file's frame: their own node counts for
  /// nothing.
  void bend_skinned_parts() {
    const std::vector<glm::mat4> model_from_node = rest_pose(model_);
    const glm::mat4 file_from_model = glm::inverse(model_from_node.front());
    for (const Skinned& skinned : skinned_) {
      Part& part = model_.parts[skinned.part];
      const GltfSkin skin = read_skin(file_, skinned.skin);
      std::vector<glm::mat4> file_from_mesh;
      for (std::size_t i = 0; i < skin.joints.size(); ++i) {
        const int node = node_of_gltf_[std::size_t(skin.joints[i])];
        if (node == no_index)
          fail("skin \"{}\": joint {} is missing from the scene", skin.name, skin.joints[i]);
        file_from_mesh.push_back(file_from_model * model_from_node[std::size_t(node)] *
                                 skin.joint_from_mesh[i]);
      }
      bend(part.mesh, read_skin_weights(file_, skinned.attributes, skin, part.mesh.positions.size()),
           file_from_mesh);
      part.node = 0;
      if (const Status status = check(part.mesh, "skin \"" + skin.name + "\""); !status)
        fail("{}", status.errors().front().message);
    }
  }

  template <int N>
  std::vector<glm::vec<N, float>> attribute(const Json& attributes, const std::string& name) const {
    const int accessor = file_.index(attributes, name.c_str(), "accessors");
    if (accessor < 0) return {};
    const std::vector<float> values = file_.floats(accessor, N);
    std::vector<glm::vec<N, float>> result(values.size() / N);
    for (std::size_t i = 0; i < values.size(); ++i) result[i / N][int(i % N)] = values[i];
    return result;
  }

  Mesh read_primitive(const Json& primitive, int mode, const std::string& name) const {
    const Json& attributes = member(primitive, "attributes");
    Mesh mesh;
    mesh.positions = attribute<3>(attributes, "POSITION");
    mesh.normals = attribute<3>(attributes, "NORMAL");
    mesh.uvs = attribute<2>(attributes, "TEXCOORD_0");
    const std::size_t count = mesh.positions.size();
    if (mesh.uvs.empty()) mesh.uvs.resize(count, glm::vec2(0.0f));
    std::vector<std::uint32_t> order;
    if (const int accessor = file_.index(primitive, "indices", "accessors"); accessor >= 0) {
      order = file_.integers(accessor);
    } else {
      order.resize(count);
      for (std::size_t i = 0; i < count; ++i) order[i] = std::uint32_t(i);
    }
    mesh.indices = triangle_list(order, mode);
    const bool has_normals = !mesh.normals.empty();
    if (!has_normals) mesh.normals.assign(count, glm::vec3(0.0f));
    if (const Status status = check(mesh, "mesh \"" + name + "\""); !status)
      fail("{}", status.errors().front().message);
    fill_normals(mesh);
    for (glm::vec3& normal : mesh.normals) normal = glm::normalize(normal);
    return mesh;
  }

  static std::vector<std::uint32_t> triangle_list(const std::vector<std::uint32_t>& order, int mode) {
    if (mode == 4) return order;
    std::vector<std::uint32_t> list;
    for (std::size_t i = 0; i + 2 < order.size(); ++i) {
      if (mode == 5)  // in a strip every second triangle is wound the other way
        list.insert(list.end(), {order[i + i % 2], order[i + 1 - i % 2], order[i + 2]});
      else
        list.insert(list.end(), {order[0], order[i + 1], order[i + 2]});
    }
    return list;
  }

  // --- animations
  // ----------------------------------------------------------------------------------------------------

  void read_animations() {
    for (const Json& source : file_.list("animations")) {
      Animation animation;
      animation.name = source.value("name", "");
      const Json samplers = source.value("samplers", Json::array());
      for (const Json& channel : source.value("channels", Json::array()))
        read_channel(channel, samplers, animation);
      if (!animation.channels.empty()) model_.animations.push_back(std::move(animation));
    }
  }

  void read_channel(const Json& source, const Json& samplers, Animation& animation) const {
    using Property = AnimationChannel::Property;
    using Interpolation = AnimationChannel::Interpolation;
    const Json& target = member(source, "target");
    const std::string path = target.value("path", "");
    const int gltf_node = file_.index(target, "node", "nodes");
    if (gltf_node < 0 || node_of_gltf_[std::size_t(gltf_node)] == no_index || path == "weights") return;
    const Json& sampler = samplers.at(source.value("sampler", std::size_t(0)));

    AnimationChannel channel;
    channel.node = node_of_gltf_[std::size_t(gltf_node)];
    if (path == "translation")
      channel.property = Property::translation;
    else if (path == "rotation")
      channel.property = Property::rotation;
    else if (path == "scale")
      channel.property = Property::scale;
    else
      fail("an animation moves \"{}\"; expected translation, rotation, scale or weights", path);
    const std::string interpolation = sampler.value("interpolation", "LINEAR");
    channel.interpolation = interpolation == "STEP"          ? Interpolation::step
                            : interpolation == "CUBICSPLINE" ? Interpolation::cubic
                                                             : Interpolation::linear;
    const int input = file_.index(sampler, "input", "accessors"),
              output = file_.index(sampler, "output", "accessors");
    if (input < 0 || output < 0) fail("an animation sampler lacks its input or output");
    channel.times_s = file_.floats(input, 1);
    const int components = channel.property == Property::rotation ? 4 : 3;
    const std::vector<float> values = file_.floats(output, components);
    channel.values.resize(values.size() / std::size_t(components), glm::vec4(0.0f));
    for (std::size_t i = 0; i < values.size(); ++i)
      channel.values[i / std::size_t(components)][int(i % std::size_t(components))] = values[i];

    const std::size_t wanted =
        channel.times_s.size() * (channel.interpolation == Interpolation::cubic ? 3 : 1);
    const bool ascends = std::is_sorted(channel.times_s.begin(), channel.times_s.end());
    const auto finite = [](float value) { return std::isfinite(value); };
    if (channel.times_s.empty() || channel.values.size() != wanted || !ascends ||
        !std::all_of(values.begin(), values.end(), finite) ||
        !std::all_of(channel.times_s.begin(), channel.times_s.end(), finite))
      fail("animation \"{}\": {} times and {} values; expected finite, ascending times and as many values",
           animation.name, channel.times_s.size(), channel.values.size());
    animation.duration_s = std::max(animation.duration_s, channel.times_s.back());
    animation.channels.push_back(std::move(channel));
  }

  GltfFile file_;
  Errors& warnings_;
  Model model_;
  std::map<std::pair<int, bool>, int> textures_;  ///< (glTF texture, is sRGB) to the model's texture
  std::vector<int> images_;                       ///< of each of the model's textures
  std::vector<int> node_of_gltf_;
  struct Skinned {
    std::size_t part;
    int skin;
    Json attributes;  ///< of the primitive
  };
  std::vector<Skinned> skinned_;
  int default_material_ = 0;
};

}  // namespace

Result<Model> read_gltf(const std::filesystem::path& file, Errors& warnings) {
  const FileLocation where{file.string(), 0, 0};
  try {
    return Reader(file, warnings).read();
  } catch (const Problem& problem) {
    return Error{problem.message, where};
  } catch (const Json::exception& problem) {
    return error_at(where, "a value is not of the kind that glTF asks for ({})", problem.what());
  }
}

}  // namespace parvis::scene
