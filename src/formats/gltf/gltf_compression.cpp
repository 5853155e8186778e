#include "formats/gltf/gltf_compression.h"

#include <draco/compression/decode.h>
#include <meshoptimizer.h>

#include <array>
#include <cstring>

#include "base/checked.h"
#include "base/exception_reason.h"
#include "formats/gltf/gltf_values.h"
#include "formats/gltf/gltf_vertex_codec.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;
using Bytes = std::vector<std::uint8_t>;

constexpr const char *meshopt = "EXT_meshopt_compression", *khr_meshopt = "KHR_meshopt_compression",
                     *draco_mesh = "KHR_draco_mesh_compression";
constexpr std::size_t max_compressed_elements = 20'000'000;  // a hostile count must not allocate

std::size_t count_in(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end() || !found->is_number_unsigned() ||
      found->get<std::size_t>() > max_compressed_elements * 16)
    gltf_fail("{}: \"{}\" is missing or no sensible number", meshopt, name);
  return found->get<std::size_t>();
}

/// Appends `bytes` as a buffer with one view; gives the view's index.
std::size_t add_view(Json& json, std::vector<Bytes>& buffers, Bytes bytes, Json view = Json::object()) {
  view["buffer"] = buffers.size();
  view["byteOffset"] = 0u;
  view["byteLength"] = bytes.size();
  json["buffers"].push_back({{"byteLength", bytes.size()}});
  buffers.push_back(std::move(bytes));
  json["bufferViews"].push_back(std::move(view));
  return json["bufferViews"].size() - 1;
}

// --- EXT_meshopt_compression, KHR_meshopt_compression

/// How a buffer view is packed; empty where it is not.
const Json& packing_of(const Json& view) {
  const Json& packing = gltf_extension(view, khr_meshopt);
  return packing.empty() ? gltf_extension(view, meshopt) : packing;
}

/// Checks the library's assertions: a file may violate them.
bool fits_mode(const std::string& mode, std::size_t count, std::size_t stride) {
  if (mode == "ATTRIBUTES") return stride > 0 && stride <= 256 && stride % 4 == 0;
  return (mode == "INDICES" || (mode == "TRIANGLES" && count % 3 == 0)) && (stride == 2 || stride == 4);
}

bool fits_filter(const std::string& filter, std::size_t stride) {
  if (filter == "OCTAHEDRAL" || filter == "COLOR") return stride == 4 || stride == 8;
  if (filter == "QUATERNION") return stride == 8;
  return filter == "EXPONENTIAL" || filter == "NONE";
}

int decode(const std::string& mode, Bytes& plain, std::size_t count, std::size_t stride,
           std::span<const std::uint8_t> packed) {
  if (mode == "ATTRIBUTES" && is_vertex_codec_1(packed))
    return decode_vertices_1(packed, count, stride, plain) ? 0 : -1;
  if (mode == "ATTRIBUTES")
    return meshopt_decodeVertexBuffer(plain.data(), count, stride, packed.data(), packed.size());
  if (mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(plain.data(), count, stride, packed.data(), packed.size());
  return meshopt_decodeIndexSequence(plain.data(), count, stride, packed.data(), packed.size());
}

void undo_filter(const std::string& filter, Bytes& plain, std::size_t count, std::size_t stride) {
  if (filter == "COLOR") decode_colours(plain, count, stride);
  if (filter == "OCTAHEDRAL") meshopt_decodeFilterOct(plain.data(), count, stride);
  if (filter == "QUATERNION") meshopt_decodeFilterQuat(plain.data(), count, stride);
  if (filter == "EXPONENTIAL") meshopt_decodeFilterExp(plain.data(), count, stride);
}

Bytes unpacked_view(const GltfFile& file, const Json& packing, const std::vector<Bytes>& buffers,
                    std::size_t view) {
  const int buffer = file.index(packing, "buffer", "buffers");
  const std::size_t offset = packing.contains("byteOffset") ? count_in(packing, "byteOffset") : 0,
                    length = count_in(packing, "byteLength"), count = count_in(packing, "count"),
                    stride = count_in(packing, "byteStride");
  const std::string mode = packing.value("mode", ""), filter = packing.value("filter", "NONE");
  if (buffer < 0 || !bytes_fit(offset, length, buffers[std::size_t(buffer)].size()))
    gltf_fail("buffer view {}: its {} reaches beyond its buffer", view, meshopt);
  if (count > max_compressed_elements || !fits_mode(mode, count, stride) || !fits_filter(filter, stride))
    gltf_fail("buffer view {}: {} elements of {} bytes, mode \"{}\", filter \"{}\" are none of {}'s", view,
              count, stride, mode, filter, meshopt);
  gltf_charge(checked_product({count, stride}), "buffer view {}, decompressed,", view);
  Bytes plain((count * stride + 3) / 4 * 4);
  const std::span<const std::uint8_t> packed =
      std::span(buffers[std::size_t(buffer)]).subspan(offset, length);
  if (decode(mode, plain, count, stride, packed) != 0)
    gltf_fail("buffer view {}: its compressed bytes ({}) are damaged", view, meshopt);
  undo_filter(filter, plain, count, stride);
  return plain;
}

void decompress_views(const GltfFile& file, Json& json, std::vector<Bytes>& buffers) {
  const std::size_t view_count = file.list("bufferViews").size();
  for (std::size_t i = 0; i < view_count; ++i) {
    const Json packing = packing_of(file.list("bufferViews")[i]);
    if (packing.empty()) continue;
    Json view = Json::object();
    if (packing.value("mode", "") == "ATTRIBUTES") view["byteStride"] = packing["byteStride"];
    const std::size_t added = add_view(json, buffers, unpacked_view(file, packing, buffers, i), view);
    json["bufferViews"][i] = json["bufferViews"][added];
  }
}

// --- KHR_draco_mesh_compression

std::unique_ptr<draco::Mesh> decoded(std::span<const std::uint8_t> bytes, const std::string& mesh_name) {
  draco::DecoderBuffer source;
  source.Init(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  try {
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&source);
    if (mesh.ok() && mesh.value()->num_points() <= max_compressed_elements) return std::move(mesh).value();
    gltf_fail("mesh \"{}\": its compressed bytes ({}) are damaged: {}", mesh_name, draco_mesh,
              mesh.ok() ? "too many points" : mesh.status().error_msg_string());
  } catch (const std::exception& problem) {
    gltf_fail("mesh \"{}\": its compressed bytes ({}) are damaged: {}", mesh_name, draco_mesh,
              reason_of(problem));
  }
}

/// Largest value of a normalised component; 1 for those that stand for themselves.
float unit_of(const Json& accessor) {
  if (!accessor.value("normalized", false)) return 1.0f;
  switch (accessor.value("componentType", 0)) {
    case 5120:
      return 127.0f;
    case 5121:
      return 255.0f;
    case 5122:
      return 32767.0f;
    case 5123:
      return 65535.0f;
    default:
      return 1.0f;
  }
}

/// The attribute's values as floats, one element a point.
void put_attribute(const draco::Mesh& mesh, const draco::PointAttribute& attribute, Json& json,
                   std::vector<Bytes>& buffers, Json& accessor) {
  const std::size_t components = std::size_t(attribute.num_components());
  constexpr std::array<const char*, 5> types{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  if (components < 1 || components > 4)
    gltf_fail("{}: an attribute has {} components", draco_mesh, components);
  const float unit = attribute.normalized() ? 1.0f : unit_of(accessor);
  gltf_charge(checked_product({2, components, mesh.num_points(), sizeof(float)}), "{}: an attribute",
              draco_mesh);
  std::vector<float> values(components * mesh.num_points());
  for (draco::PointIndex point(0); point < mesh.num_points(); ++point) {
    float* value = values.data() + components * point.value();
    if (!attribute.ConvertValue<float>(attribute.mapped_index(point), int8_t(components), value))
      gltf_fail("{}: an attribute's values cannot be read", draco_mesh);
    for (std::size_t c = 0; c < components; ++c) value[c] /= unit;
  }
  Bytes bytes(values.size() * sizeof(float));
  if (!bytes.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  accessor = {{"bufferView", add_view(json, buffers, std::move(bytes))},
              {"componentType", 5126u},
              {"count", mesh.num_points()},
              {"type", types[components]}};
}

void put_indices(const draco::Mesh& mesh, Json& json, std::vector<Bytes>& buffers, Json& accessor) {
  Bytes bytes(std::size_t(mesh.num_faces()) * 3 * sizeof(std::uint32_t));
  std::uint8_t* to = bytes.data();
  for (draco::FaceIndex face(0); face < mesh.num_faces(); ++face)
    for (const draco::PointIndex& corner : mesh.face(face)) {
      const std::uint32_t index = corner.value();
      std::memcpy(to, &index, sizeof(index));
      to += sizeof(index);
    }
  accessor = {{"bufferView", add_view(json, buffers, std::move(bytes))},
              {"componentType", 5125u},
              {"count", 3 * std::size_t(mesh.num_faces())},
              {"type", "SCALAR"}};
}

void decompress_primitive(const GltfFile& file, Json& json, std::vector<Bytes>& buffers,
                          const Json& primitive, const std::string& mesh_name) {
  const Json& packing = gltf_extension(primitive, draco_mesh);
  if (packing.empty()) return;
  const int view = file.index(packing, "bufferView", "bufferViews");
  if (view < 0) gltf_fail("mesh \"{}\": {} names no buffer view", mesh_name, draco_mesh);
  const std::unique_ptr<draco::Mesh> mesh = decoded(file.buffer_view(view), mesh_name);
  for (const auto& [name, id] : gltf_member(packing, "attributes").items()) {
    const int accessor = file.index(gltf_member(primitive, "attributes"), name.c_str(), "accessors");
    const draco::PointAttribute* attribute =
        id.is_number_unsigned() ? mesh->GetAttributeByUniqueId(id.get<std::uint32_t>()) : nullptr;
    if (accessor < 0 || !attribute)
      gltf_fail("mesh \"{}\": {} has no attribute {} for {}", mesh_name, draco_mesh, id.dump(), name);
    put_attribute(*mesh, *attribute, json, buffers, json["accessors"][std::size_t(accessor)]);
  }
  if (const int accessor = file.index(primitive, "indices", "accessors"); accessor >= 0)
    put_indices(*mesh, json, buffers, json["accessors"][std::size_t(accessor)]);
}

}  // namespace

std::vector<char> needed_buffers(const GltfFile& file) {
  const Json &buffers = file.list("buffers"), &views = file.list("bufferViews");
  std::vector<char> is_packed(views.size(), 0), is_needed(buffers.size(), 0);
  // What draco replaces is read by nobody, unless another primitive reads it too.
  for (const Json& mesh : file.list("meshes"))
    for (const Json& primitive : mesh.value("primitives", Json::array())) {
      const Json& packing = gltf_extension(primitive, draco_mesh);
      const Json& attributes = gltf_member(primitive, "attributes");
      const auto mark = [&](int accessor, bool is_replaced) {
        if (accessor < 0) return;
        const int view =
            file.index(file.list("accessors")[std::size_t(accessor)], "bufferView", "bufferViews");
        if (view >= 0) is_packed[std::size_t(view)] |= is_replaced ? 1 : 2;
      };
      for (const auto& [name, accessor] : attributes.items())
        mark(file.index(attributes, name.c_str(), "accessors"),
             gltf_member(packing, "attributes").contains(name));
      mark(file.index(primitive, "indices", "accessors"), !packing.empty());
    }
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Json& packing = packing_of(views[i]);
    const int buffer = file.index(packing.empty() ? views[i] : packing, "buffer", "buffers");
    if (buffer >= 0 && is_packed[i] != 1) is_needed[std::size_t(buffer)] = 1;
  }
  return is_needed;
}

void decompress(const GltfFile& file, Json& json, std::vector<Bytes>& buffers) {
  decompress_views(file, json, buffers);
  for (const Json& mesh : file.list("meshes"))
    for (const Json& primitive : mesh.value("primitives", Json::array()))
      decompress_primitive(file, json, buffers, primitive, mesh.value("name", ""));
}

}  // namespace parvis::scene
