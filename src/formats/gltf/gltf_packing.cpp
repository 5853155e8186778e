#include "formats/gltf/gltf_packing.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cstring>
#include <glm/glm.hpp>
#include <limits>
#include <set>
#include <string>

namespace parvis::scene {
namespace {

using Json = nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

constexpr const char *packed_views = "EXT_meshopt_compression", *packed_numbers = "KHR_mesh_quantization";
constexpr int byte_component = 5120, short_component = 5123;
constexpr int position_bits = 20, uv_bits = 16, normal_bits = 8;

class Packer {
 public:
  Packer(Json& json, const Bytes& bytes) : json_(json), bytes_(bytes) {}

  void pack() {
    for (Json& mesh : json_["meshes"])
      for (Json& primitive : mesh["primitives"])
        if (done_.insert(primitive["indices"].get<std::size_t>()).second) pack(primitive);
    for (std::size_t i = 0; i < json_["accessors"].size(); ++i)
      if (!used_.contains(i)) json_["accessors"][i].erase("bufferView");
    json_["bufferViews"] = views_;
    json_["buffers"] = {
        {{"byteLength", packed_.size()}},
        {{"byteLength", unpacked_size_}, {"extensions", {{packed_views, {{"fallback", true}}}}}}};
    for (const char* list : {"extensionsUsed", "extensionsRequired"})
      for (const char* name : {packed_views, packed_numbers}) json_[list].push_back(name);
  }

  Bytes& packed() { return packed_; }

 private:
  template <class T>
  std::vector<T> values(std::size_t accessor, std::size_t components) const {
    const Json& described = json_["accessors"][accessor];
    const Json& view = json_["bufferViews"][described["bufferView"].get<std::size_t>()];
    std::vector<T> read(described["count"].get<std::size_t>() * components);
    std::memcpy(read.data(), bytes_.data() + view["byteOffset"].get<std::size_t>(), read.size() * sizeof(T));
    return read;
  }

  /// Adds a packed view and lets the accessor read it.
  void add(std::size_t accessor, const Bytes& packed, std::size_t count, std::size_t stride, const char* mode,
           const char* filter) {
    while (packed_.size() % 4 != 0) packed_.push_back(0);
    Json packing{{"buffer", 0},
                 {"byteOffset", packed_.size()},
                 {"byteLength", packed.size()},
                 {"byteStride", stride},
                 {"mode", mode},
                 {"count", count}};
    if (filter) packing["filter"] = filter;
    packed_.insert(packed_.end(), packed.begin(), packed.end());
    unpacked_size_ = (unpacked_size_ + 3) / 4 * 4;
    Json view{{"buffer", 1}, {"byteOffset", unpacked_size_}, {"byteLength", count * stride}};
    if (std::string(mode) == "ATTRIBUTES") view["byteStride"] = stride;
    view["extensions"][packed_views] = packing;
    unpacked_size_ += count * stride;
    json_["accessors"][accessor]["bufferView"] = views_.size();
    views_.push_back(view);
    used_.insert(accessor);
  }

  void add_vertices(std::size_t accessor, const void* data, std::size_t count, std::size_t stride,
                    const char* filter = nullptr) {
    Bytes packed(meshopt_encodeVertexBufferBound(count, stride));
    packed.resize(meshopt_encodeVertexBuffer(packed.data(), packed.size(), data, count, stride));
    add(accessor, packed, count, stride, "ATTRIBUTES", filter);
  }

  /// Floats with a common exponent for each vertex. Returns what a reader will find.
  std::vector<float> add_floats(std::size_t accessor, const std::vector<float>& floats,
                                std::size_t components, int bits) {
    const std::size_t count = floats.size() / components;
    std::vector<std::uint32_t> filtered(floats.size());
    meshopt_encodeFilterExp(filtered.data(), count, 4 * components, bits, floats.data());
    add_vertices(accessor, filtered.data(), count, 4 * components, "EXPONENTIAL");
    meshopt_decodeFilterExp(filtered.data(), count, 4 * components);
    std::vector<float> found(floats.size());
    std::memcpy(found.data(), filtered.data(), 4 * found.size());
    return found;
  }

  void add_positions(std::size_t accessor, const std::vector<float>& floats) {
    const std::vector<float> found = add_floats(accessor, floats, 3, position_bits);
    glm::vec3 min(std::numeric_limits<float>::max()), max(-min);
    for (std::size_t i = 0; i + 2 < found.size(); i += 3) {
      const glm::vec3 p(found[i], found[i + 1], found[i + 2]);
      min = glm::min(min, p), max = glm::max(max, p);
    }
    json_["accessors"][accessor]["min"] = {min.x, min.y, min.z};
    json_["accessors"][accessor]["max"] = {max.x, max.y, max.z};
  }

  void add_normals(std::size_t accessor, const std::vector<float>& floats) {
    const std::size_t count = floats.size() / 3;
    std::vector<float> wide(4 * count, 0.0f);
    for (std::size_t i = 0; i < count; ++i) std::copy_n(floats.data() + 3 * i, 3, wide.data() + 4 * i);
    Bytes filtered(4 * count);
    meshopt_encodeFilterOct(filtered.data(), count, 4, normal_bits, wide.data());
    add_vertices(accessor, filtered.data(), count, 4, "OCTAHEDRAL");
    json_["accessors"][accessor]["componentType"] = byte_component;
    json_["accessors"][accessor]["normalized"] = true;
  }

  void add_colours(std::size_t accessor, const std::vector<float>& floats) {
    std::vector<std::uint16_t> narrow(floats.size());
    for (std::size_t i = 0; i < floats.size(); ++i)
      narrow[i] = std::uint16_t(std::clamp(floats[i], 0.0f, 1.0f) * 65535.0f + 0.5f);
    add_vertices(accessor, narrow.data(), narrow.size() / 4, 8);
    json_["accessors"][accessor]["componentType"] = short_component;
    json_["accessors"][accessor]["normalized"] = true;
  }

  void add_indices(std::size_t accessor, const std::vector<std::uint32_t>& indices, std::size_t vertices) {
    Bytes packed(meshopt_encodeIndexBufferBound(indices.size(), vertices));
    packed.resize(meshopt_encodeIndexBuffer(packed.data(), packed.size(), indices.data(), indices.size()));
    const bool is_short = vertices <= std::numeric_limits<std::uint16_t>::max();
    if (is_short) json_["accessors"][accessor]["componentType"] = short_component;
    add(accessor, packed, indices.size(), is_short ? 2 : 4, "TRIANGLES", nullptr);
  }

  void pack(Json& primitive) {
    const auto index_accessor = primitive["indices"].get<std::size_t>();
    std::vector<std::uint32_t> indices = values<std::uint32_t>(index_accessor, 1);
    const auto before = json_["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()]["count"]
                            .get<std::size_t>();
    meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), before);
    std::vector<std::uint32_t> order(before);
    const std::size_t count =
        meshopt_optimizeVertexFetchRemap(order.data(), indices.data(), indices.size(), before);
    meshopt_remapIndexBuffer(indices.data(), indices.data(), indices.size(), order.data());
    for (const auto& [name, number] : primitive["attributes"].items()) {
      const auto accessor = number.get<std::size_t>();
      const std::size_t components = name.starts_with("TEXCOORD") ? 2 : name.starts_with("COLOR") ? 4 : 3;
      std::vector<float> floats = values<float>(accessor, components);
      meshopt_remapVertexBuffer(floats.data(), floats.data(), before, 4 * components, order.data());
      floats.resize(count * components);
      json_["accessors"][accessor]["count"] = count;
      if (name == "POSITION")
        add_positions(accessor, floats);
      else if (name == "NORMAL")
        add_normals(accessor, floats);
      else if (components == 4)
        add_colours(accessor, floats);
      else
        add_floats(accessor, floats, components, uv_bits);
    }
    add_indices(index_accessor, indices, count);
  }

  Json& json_;
  const Bytes& bytes_;
  Bytes packed_;
  std::size_t unpacked_size_ = 0;
  Json views_ = Json::array();
  std::set<std::size_t> done_, used_;
};

}  // namespace

void pack_meshes(Json& json, Bytes& bytes) {
  meshopt_encodeVertexVersion(0), meshopt_encodeIndexVersion(1);  // those of the extension
  Packer packer(json, bytes);
  packer.pack();
  bytes = std::move(packer.packed());
}

}  // namespace parvis::scene
