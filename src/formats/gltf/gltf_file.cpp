#include "formats/gltf/gltf_file.h"

#include <array>
#include <cmath>
#include <cstring>

#include "base/checked.h"
#include "base/files.h"
#include "base/json_guard.h"
#include "formats/gltf/gltf_compression.h"
#include "formats/gltf/gltf_extensions.h"
#include "formats/gltf/gltf_values.h"
#include "formats/readers/packed_file.h"

namespace parvis::scene {
namespace fs = std::filesystem;
using Json = GltfFile::Json;
namespace {

constexpr std::uint32_t glb_magic = 0x46546C67, json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;
constexpr std::size_t max_elements =
    20'000'000;  // no model of a city needs more; a hostile count must not allocate

std::uint32_t word(const std::string& bytes, std::size_t at) {
  if (at + 4 > bytes.size()) gltf_fail("the file is cut short at byte {}", bytes.size());
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, 4);
  return value;
}

std::size_t size_of(const Json& object, const char* name, std::size_t otherwise = 0) {
  const auto found = object.find(name);
  if (found == object.end()) return otherwise;
  if (!found->is_number_unsigned())
    gltf_fail("\"{}\" is {}; expected a whole number that is not negative", name, found->dump());
  return found->get<std::size_t>();
}

std::size_t component_bytes(std::size_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      gltf_fail("component type {} is none of glTF's", type);
  }
}

int component_count(const std::string& type) {
  constexpr std::array<std::pair<const char*, int>, 7> types{
      {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}}};
  for (const auto& [name, count] : types)
    if (type == name) return count;
  gltf_fail("accessor type \"{}\" is none of glTF's", type);
}

template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

double component(const std::uint8_t* bytes, std::size_t type) {
  switch (type) {
    case 5120:
      return load<std::int8_t>(bytes);
    case 5121:
      return *bytes;
    case 5122:
      return load<std::int16_t>(bytes);
    case 5123:
      return load<std::uint16_t>(bytes);
    case 5125:
      return load<std::uint32_t>(bytes);
    default:
      return double(load<float>(bytes));
  }
}

double normalised(double value, std::size_t type) {
  switch (type) {
    case 5120:
      return std::max(value / 127.0, -1.0);
    case 5121:
      return value / 255.0;
    case 5122:
      return std::max(value / 32767.0, -1.0);
    case 5123:
      return value / 65535.0;
    default:
      return value;
  }
}

std::vector<std::uint8_t> base64_decoded(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    int value = -1;
    if (c >= 'A' && c <= 'Z')
      value = c - 'A';
    else if (c >= 'a' && c <= 'z')
      value = c - 'a' + 26;
    else if (c >= '0' && c <= '9')
      value = c - '0' + 52;
    else if (c == '+' || c == '-')
      value = 62;
    else if (c == '/' || c == '_')
      value = 63;
    else if (c == '=')
      break;
    else
      gltf_fail("a data URI holds a character that is not base64");
    group = (group << 6) | std::uint32_t(value);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes.push_back(std::uint8_t(group >> bits));
  }
  return bytes;
}

/// "%20" and its like, which exporters write into file names.
std::string percent_decoded(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && std::isxdigit(static_cast<unsigned char>(text[i + 1])) &&
        std::isxdigit(static_cast<unsigned char>(text[i + 2]))) {
      result += char(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

}  // namespace

static Json guarded_json(std::string_view text) {
  if (const Status depth = check_json_depth(text, "glTF"); !depth)
    gltf_fail("{}", depth.errors().front().message);
  return Json::parse(text);
}

/// Where an accessor's elements lie.
struct GltfFile::Access {
  std::size_t count = 0, type = 5126, components = 1, stride = 0;
  bool is_normalised = false;
  const std::uint8_t* first = nullptr;  ///< null: all zero
};

GltfFile::GltfFile(const fs::path& file) : path_(file) {
  const Result<std::string> bytes = formats::read_unpacked(file);
  if (!bytes) gltf_fail("{}", bytes.errors().front().message);
  try {
    read_container(*bytes);
  } catch (const Json::exception& problem) {
    gltf_fail("its JSON cannot be read: {}", json_reason(problem.what()));
  }
  if (!json_.is_object() || !json_.contains("asset")) gltf_fail("this is no glTF: it has no \"asset\"");
  const std::string version = json_["asset"].value("version", "");
  if (version.empty() || version[0] != '2') gltf_fail("glTF version \"{}\"; only version 2 is read", version);
  check_required_extensions(*this);
  read_buffers();
  decompress(*this, json_, buffers_);
}

void GltfFile::read_container(const std::string& bytes) {
  if (formats::model_extension(path_) != ".glb" && !bytes.starts_with("glTF")) {
    json_ = guarded_json(bytes);
    return;
  }
  if (word(bytes, 0) != glb_magic) gltf_fail("this is no .glb: its first bytes are not \"glTF\"");
  if (word(bytes, 4) != 2) gltf_fail(".glb version {}; only version 2 is read", word(bytes, 4));
  if (word(bytes, 8) > bytes.size())
    gltf_fail("the file is cut short: it says that it has {} bytes and has {}", word(bytes, 8), bytes.size());
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t length = word(bytes, at), type = word(bytes, at + 4);
    if (at + 8 + length > bytes.size()) gltf_fail("a chunk claims {} bytes, more than the file has", length);
    const char* data = bytes.data() + at + 8;
    if (type == json_chunk && json_.is_null()) json_ = guarded_json({data, length});
    if (type == binary_chunk && binary_chunk_.empty()) binary_chunk_.assign(data, data + length);
    at += 8 + (length + 3) / 4 * 4;
  }
  if (json_.is_null()) gltf_fail("this .glb has no JSON chunk");
}

void GltfFile::read_buffers() {
  const Json& descriptions = list("buffers");
  const std::vector<char> is_needed = needed_buffers(*this);
  for (std::size_t i = 0; i < descriptions.size(); ++i) {
    const Json& description = descriptions[i];
    buffers_.emplace_back();
    if (is_needed[i] == 0) continue;
    buffers_.back() =
        description.contains("uri") ? resource(description["uri"].get<std::string>()) : binary_chunk_;
    const std::size_t claimed = size_of(description, "byteLength");
    if (claimed > buffers_.back().size())
      gltf_fail("buffer {} claims {} bytes and there are {}; the file is cut short", i, claimed,
                buffers_.back().size());
  }
}

const Json& GltfFile::list(const char* name) const {
  static const Json nothing = Json::array();
  const auto found = json_.find(name);
  if (found == json_.end()) return nothing;
  if (!found->is_array()) gltf_fail("\"{}\" is no list", name);
  return *found;
}

int GltfFile::index(const Json& object, const char* name, const char* list_name) const {
  if (!object.is_object()) gltf_fail("expected an object with \"{}\"", name);
  const auto found = object.find(name);
  if (found == object.end()) return -1;
  const std::size_t count = list(list_name).size();
  if (!found->is_number_unsigned() || found->get<std::size_t>() >= count)
    gltf_fail("\"{}\" is {}, out of range; there are {} {}", name, found->dump(), count, list_name);
  return found->get<int>();
}

std::vector<std::uint8_t> GltfFile::resource(const std::string& uri) const {
  if (uri.starts_with("data:")) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string::npos) gltf_fail("a data URI without data");
    return base64_decoded(std::string_view(uri).substr(comma + 1));
  }
  const Result<fs::path> found = Roots(path_.parent_path()).find(percent_decoded(uri), {});
  if (!found) gltf_fail("{}", found.errors().front().message);
  const Result<std::string> bytes = read_file(*found);
  if (!bytes) gltf_fail("{}", bytes.errors().front().message);
  return {bytes->begin(), bytes->end()};
}

std::span<const std::uint8_t> GltfFile::buffer_view(int view) const {
  const Json& description = list("bufferViews")[std::size_t(view)];
  const int buffer = index(description, "buffer", "buffers");
  if (buffer < 0) gltf_fail("buffer view {} names no buffer", view);
  const std::vector<std::uint8_t>& bytes = buffers_[std::size_t(buffer)];
  const std::size_t offset = size_of(description, "byteOffset"), length = size_of(description, "byteLength");
  if (!bytes_fit(offset, length, bytes.size()))
    gltf_fail("buffer view {} reaches from byte {} over {} bytes, beyond the {} of buffer {}", view, offset,
              length, bytes.size(), buffer);
  return std::span(bytes).subspan(offset, length);
}

GltfFile::Access GltfFile::access(int accessor, int components) const {
  const Json& description = list("accessors")[std::size_t(accessor)];
  Access access;
  access.count = size_of(description, "count");
  access.type = size_of(description, "componentType", 5126);
  access.components = std::size_t(component_count(description.value("type", "SCALAR")));
  access.is_normalised = description.value("normalized", false);
  if (access.components != std::size_t(components))
    gltf_fail("accessor {} has {} components; expected {}", accessor, access.components, components);
  if (access.count > max_elements) gltf_fail("accessor {} claims {} elements", accessor, access.count);
  const int view = index(description, "bufferView", "bufferViews");
  const std::size_t element = component_bytes(access.type) * access.components;
  if (view < 0) return access;
  const std::span<const std::uint8_t> bytes = buffer_view(view);
  access.stride = size_of(list("bufferViews")[std::size_t(view)], "byteStride", element);
  const std::size_t offset = size_of(description, "byteOffset");
  const bool fits = access.stride >= element && access.stride <= 65536 &&
                    elements_fit(offset, access.count, access.stride, element, bytes.size());
  if (!fits)
    gltf_fail("accessor {} claims {} elements of {} bytes, more than its buffer view has", accessor,
              access.count, element);
  access.first = bytes.data() + offset;
  return access;
}

/// Calls store(element * components + component, value), sparse replacements last.
template <class Store>
void GltfFile::read_elements(int accessor, int components, const Store& store) const {
  const Access dense = access(accessor, components);
  const auto read_at = [&](const std::uint8_t* from, std::size_t element) {
    for (std::size_t c = 0; c < dense.components; ++c) {
      const double value = component(from + c * component_bytes(dense.type), dense.type);
      store(element * dense.components + c, dense.is_normalised ? normalised(value, dense.type) : value);
    }
  };
  if (dense.first)
    for (std::size_t i = 0; i < dense.count; ++i) read_at(dense.first + i * dense.stride, i);

  const Json& description = list("accessors")[std::size_t(accessor)];
  if (!description.contains("sparse")) return;
  const Json& sparse = description["sparse"];
  const std::size_t count = size_of(sparse, "count");
  const Json &indices = sparse.at("indices"), &values = sparse.at("values");
  const int index_view = index(indices, "bufferView", "bufferViews"),
            value_view = index(values, "bufferView", "bufferViews");
  if (index_view < 0 || value_view < 0) gltf_fail("accessor {}: sparse without buffer views", accessor);
  const std::size_t index_type = size_of(indices, "componentType"), index_bytes = component_bytes(index_type);
  const std::size_t element = component_bytes(dense.type) * dense.components;
  const std::span<const std::uint8_t> all_indices = buffer_view(index_view),
                                      all_values = buffer_view(value_view);
  const std::size_t index_offset = size_of(indices, "byteOffset"),
                    value_offset = size_of(values, "byteOffset");
  if (count > dense.count ||
      !elements_fit(index_offset, count, index_bytes, index_bytes, all_indices.size()) ||
      !elements_fit(value_offset, count, element, element, all_values.size()))
    gltf_fail("accessor {}: its sparse part claims {} elements, more than there are", accessor, count);
  for (std::size_t i = 0; i < count; ++i) {
    const double target = component(all_indices.data() + index_offset + i * index_bytes, index_type);
    if (!(target >= 0.0 && target < double(dense.count)))
      gltf_fail("accessor {}: sparse index {} is out of range", accessor, target);
    read_at(all_values.data() + value_offset + i * element, std::size_t(target));
  }
}

std::size_t GltfFile::element_count(int accessor) const {
  return size_of(list("accessors")[std::size_t(accessor)], "count");
}

std::vector<float> GltfFile::floats(int accessor, int components) const {
  gltf_charge(checked_product({element_count(accessor), std::uint64_t(components), sizeof(float)}),
              "accessor {}", accessor);
  std::vector<float> values(access(accessor, components).count * std::size_t(components), 0.0f);
  read_elements(accessor, components, [&](std::size_t i, double value) { values[i] = float(value); });
  return values;
}

std::vector<std::uint32_t> GltfFile::integers(int accessor) const {
  gltf_charge(checked_product({element_count(accessor), sizeof(std::uint32_t)}), "accessor {}", accessor);
  std::vector<std::uint32_t> values(access(accessor, 1).count, 0);
  read_elements(accessor, 1,
                [&](std::size_t i, double value) { values[i] = value >= 0.0 ? std::uint32_t(value) : ~0u; });
  return values;
}

}  // namespace parvis::scene
