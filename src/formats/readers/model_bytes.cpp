#include "formats/readers/model_bytes.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <type_traits>

#include "base/checked.h"
#include "base/sealed_file.h"

namespace parvis::formats {
namespace {

using namespace scene;

/// Writes each field that it is given, into memory that has room for all of them.
class Putter {
 public:
  explicit Putter(std::span<std::byte> to) : to_(to) {}

  template <class T>
  void value(const T& value) {
    put(&value, sizeof value);
  }
  template <class T>
  void array(const T& values) {
    value(std::uint64_t(values.size()));
    put(values.data(), values.size() * sizeof values[0]);
  }
  template <class T, class Each>
  void list(const std::vector<T>& items, const Each& each) {
    value(std::uint64_t(items.size()));
    for (const T& item : items) each(item);
  }

 private:
  void put(const void* bytes, std::size_t size) {
    assert(size <= to_.size());
    if (size > 0) std::memcpy(to_.data(), bytes, size);
    to_ = to_.subspan(size);
  }

  std::span<std::byte> to_;
};

/// Counts the bytes of each field that it is given.
class Counter {
 public:
  std::uint64_t bytes() const { return bytes_; }

  template <class T>
  void value(const T& value) {
    bytes_ += sizeof value;
  }
  template <class T>
  void array(const T& values) {
    bytes_ += sizeof(std::uint64_t) + values.size() * sizeof values[0];
  }
  template <class T, class Each>
  void list(const std::vector<T>& items, const Each& each) {
    bytes_ += sizeof(std::uint64_t);
    for (const T& item : items) each(item);
  }

 private:
  std::uint64_t bytes_ = 0;
};

/// Fills each field that it is given, from bytes that may be anything.
class Filler {
 public:
  explicit Filler(std::string_view bytes) : taker_(bytes) {}

  bool is_at_end() const { return taker_.is_at_end(); }

  template <class T>
  void value(T& value) {
    if constexpr (std::is_same_v<T, bool>)
      value = taker_.take<std::uint8_t>() != 0;
    else
      value = taker_.take<T>();
  }
  template <class T>
  void array(T& values) {
    using Value = std::remove_cvref_t<decltype(values[0])>;
    const std::string_view bytes =
        taker_.take_bytes(checked_product({taker_.take<std::uint64_t>(), sizeof(Value)}));
    if constexpr (sizeof(Value) == 1) {  // pixels: not filled with zeros first
      values.assign(bytes.begin(), bytes.end());
    } else {
      values.resize(bytes.size() / sizeof(Value));
      std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(values.data()));
    }
  }
  /// Grows item by item: a count that lies ends with the bytes.
  template <class T, class Each>
  void list(std::vector<T>& items, const Each& each) {
    items.clear();
    for (auto left = taker_.take<std::uint64_t>(); left > 0 && !taker_.has_ended_early(); --left)
      each(items.emplace_back());
  }

 private:
  ByteReader taker_;
};

// Each function below names the fields of one type once, for both directions: `io` is a Putter or a Counter
// and the type const, or a Filler.

template <class Io, class T>
void transfer_texture(Io& io, T& texture) {
  io.array(texture.name);
  io.value(texture.image.width), io.value(texture.image.height), io.value(texture.image.channels);
  io.array(texture.image.pixels);
  io.value(texture.is_srgb), io.value(texture.wrap_u), io.value(texture.wrap_v);
}

template <class Io, class T>
void transfer_mappings(Io& io, T& m) {
  if constexpr (!std::is_const_v<T>) m.own_mappings.emplace();
  for (auto* mapping : {&m.own_mappings->normal, &m.own_mappings->surface, &m.own_mappings->emission,
                        &m.own_mappings->occlusion})
    io.value(mapping->texture_from_uv), io.value(mapping->takes_second_uvs);
}

template <class Io, class T>
void transfer_material(Io& io, T& m) {
  io.array(m.name);
  io.value(m.base_colour), io.value(m.alpha), io.value(m.metallic), io.value(m.roughness);
  io.value(m.clear_coat), io.value(m.clear_coat_roughness), io.value(m.translucency), io.value(m.emission);
  io.value(m.base_colour_texture), io.value(m.normal_texture);
  io.value(m.surface_texture), io.value(m.emission_texture), io.value(m.normal_scale);
  io.value(m.ior), io.value(m.absorption_per_m), io.value(m.thickness_m), io.value(m.relief_m);
  io.value(m.occlusion_texture), io.value(m.occlusion_strength), io.value(m.alpha_cutoff);
  io.value(m.texture_from_mesh_uv), io.value(m.alpha_mode);
  bool has_own = m.own_mappings.has_value();
  io.value(has_own);
  if (has_own) transfer_mappings(io, m);
  io.value(m.is_double_sided), io.value(m.is_mirror_like);
}

template <class Io, class T>
void transfer_node(Io& io, T& node) {
  io.array(node.name);
  io.value(node.parent), io.value(node.translation), io.value(node.rotation), io.value(node.scale);
}

template <class Io, class T>
void transfer_deformation(Io& io, T& d) {
  io.array(d.positions), io.array(d.normals);
  io.list(d.targets, [&](auto& target) { io.array(target.positions), io.array(target.normals); });
  io.array(d.weights), io.value(d.weights_node);
  io.array(d.skin.joints), io.array(d.skin.joint_from_mesh);
  io.array(d.skin.joints_of_vertex), io.array(d.skin.weights);
}

template <class Io, class T>
void transfer_part(Io& io, T& part) {
  io.array(part.object);
  io.array(part.mesh.positions), io.array(part.mesh.normals), io.array(part.mesh.uvs);
  io.array(part.mesh.second_uvs), io.array(part.mesh.colours);
  io.array(part.mesh.indices);
  io.value(part.material), io.value(part.node), io.value(part.casts_shadow), io.value(part.is_backdrop);
  bool is_deformed = part.deformation != nullptr;
  io.value(is_deformed);
  if (!is_deformed) return;
  if constexpr (std::is_const_v<T>) {
    transfer_deformation(io, *part.deformation);
  } else {
    const auto deformation = std::make_shared<Deformation>();
    transfer_deformation(io, *deformation);
    part.deformation = deformation;
  }
}

template <class Io, class T>
void transfer_animation(Io& io, T& animation) {
  io.array(animation.name), io.value(animation.duration_s);
  io.list(animation.channels, [&](auto& channel) {
    io.value(channel.node), io.value(channel.property), io.value(channel.interpolation);
    io.array(channel.times_s), io.array(channel.values);
  });
  io.list(animation.weights, [&](auto& channel) {
    io.value(channel.node), io.value(channel.interpolation), io.array(channel.times_s);
    io.list(channel.values, [&](auto& weights) { io.array(weights); });
  });
}

template <class Io, class T>
void transfer_road(Io& io, T& road) {
  io.array(road.path), io.value(road.lanes_each_way), io.value(road.lanes_back), io.value(road.is_one_way);
  io.value(road.lane_width_m), io.value(road.speed_limit), io.array(road.name);
  io.array(road.where.file), io.value(road.where.line), io.value(road.where.column);
}

template <class Io, class T>
void transfer_model(Io& io, T& model) {
  io.array(model.name), io.value(model.origin), io.array(model.map), io.value(model.true_north_deg);
  io.list(model.textures, [&](auto& texture) { transfer_texture(io, texture); });
  io.list(model.materials, [&](auto& material) { transfer_material(io, material); });
  io.list(model.nodes, [&](auto& node) { transfer_node(io, node); });
  io.list(model.parts, [&](auto& part) { transfer_part(io, part); });
  io.list(model.animations, [&](auto& animation) { transfer_animation(io, animation); });
  io.list(model.roads, [&](auto& road) { transfer_road(io, road); });
}

// --- what a model must keep to

bool is_index(int index, std::size_t count) { return index >= 0 && std::size_t(index) < count; }

bool is_right(const Texture& texture) {
  const Image8& image = texture.image;
  if (texture.wrap_u > Wrap::clamp || texture.wrap_v > Wrap::clamp) return false;
  if (image.width < 1 || image.height < 1 || image.channels != 4) return false;
  return checked_product({std::uint64_t(image.width), std::uint64_t(image.height), 4}) == image.pixels.size();
}

bool is_right(const Material& material, std::size_t textures) {
  const auto names_one = [&](int texture) { return texture == no_index || is_index(texture, textures); };
  return names_one(material.base_colour_texture) && names_one(material.normal_texture) &&
         names_one(material.surface_texture) && names_one(material.emission_texture) &&
         names_one(material.occlusion_texture) && material.alpha_cutoff > 0.0f &&
         material.alpha_mode <= Alpha::blend;
}

bool is_right(const Deformation& d, std::size_t vertices, std::size_t nodes) {
  const auto is_whole = [&](std::size_t size) { return size == vertices; };
  for (const MorphTarget& target : d.targets)
    if ((!target.positions.empty() && !is_whole(target.positions.size())) ||
        (!target.normals.empty() && !is_whole(target.normals.size())))
      return false;
  const Skin& skin = d.skin;
  const bool has_joints = !skin.joints.empty();
  for (const int joint : skin.joints)
    if (!is_index(joint, nodes)) return false;
  for (const glm::uvec4& joints : skin.joints_of_vertex)
    for (int i = 0; i < 4; ++i)
      if (joints[i] >= skin.joints.size()) return false;
  return is_whole(d.positions.size()) && is_whole(d.normals.size()) && d.weights.size() == d.targets.size() &&
         (d.weights_node == no_index || is_index(d.weights_node, nodes)) &&
         skin.joint_from_mesh.size() == skin.joints.size() &&
         (!has_joints || (is_whole(skin.joints_of_vertex.size()) && is_whole(skin.weights.size())));
}

bool is_right(const AnimationChannel& channel, std::size_t nodes) {
  const std::size_t per_key = channel.interpolation == Interpolation::cubic ? 3 : 1;
  return is_index(channel.node, nodes) && channel.property <= AnimationChannel::Property::scale &&
         channel.interpolation <= Interpolation::cubic &&
         channel.values.size() == per_key * channel.times_s.size();
}

bool is_right(const WeightChannel& channel, std::size_t nodes) {
  const std::size_t per_key = channel.interpolation == Interpolation::cubic ? 3 : 1;
  return is_index(channel.node, nodes) && channel.interpolation <= Interpolation::cubic &&
         channel.values.size() == per_key * channel.times_s.size();
}

bool is_right(const Animation& animation, std::size_t nodes) {
  const auto fits = [&](const auto& channel) { return is_right(channel, nodes); };
  return std::ranges::all_of(animation.channels, fits) && std::ranges::all_of(animation.weights, fits);
}

bool is_right(const Model& model) {
  if (model.nodes.empty()) return false;
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].parent < no_index || model.nodes[i].parent >= int(i)) return false;
  for (const Part& part : model.parts) {
    if (!check(part.mesh, part.object) || !is_index(part.material, model.materials.size()) ||
        !is_index(part.node, model.nodes.size()))
      return false;
    if (part.deformation && !is_right(*part.deformation, part.mesh.positions.size(), model.nodes.size()))
      return false;
  }
  return std::ranges::all_of(model.textures, [](const Texture& texture) { return is_right(texture); }) &&
         std::ranges::all_of(model.materials,
                             [&](const Material& m) { return is_right(m, model.textures.size()); }) &&
         std::ranges::all_of(model.animations,
                             [&](const Animation& a) { return is_right(a, model.nodes.size()); });
}

}  // namespace

std::uint64_t byte_count(const Model& model) {
  Counter counter;
  transfer_model(counter, model);
  return counter.bytes();
}

void put_bytes(const Model& model, std::span<std::byte> to) {
  Putter putter(to);
  transfer_model(putter, model);
}

Result<Model> model_of(std::string_view bytes, const std::string& subject) {
  Model model;
  Filler filler(bytes);
  transfer_model(filler, model);
  if (!filler.is_at_end() || !is_right(model))
    return error("{}: its reader returned no whole model; the file is damaged or made to do harm", subject);
  return model;
}

}  // namespace parvis::formats
