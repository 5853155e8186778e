#include "formats/gltf/gltf_material_writer.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <map>
#include <mutex>

#include "base/content_hash.h"
#include "base/file_front.h"
#include "base/files.h"
#include "base/image_io.h"
#include "base/parallel.h"
#include "base/reduction.h"
#include "formats/gltf/gltf_chunk.h"

namespace parvis::scene {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::json;

bool uses_alpha(const Image8& image) {
  for (std::size_t i = 3; i < image.pixels.size(); i += 4)
    if (image.pixels[i] != 255) return true;
  return false;
}

constexpr int small_px = 128;  // what JPEG mixes there is most of the picture, and saves nothing

/// Colour without alpha is stored as JPEG; data, alpha and small pictures as PNG, which loses nothing.
const char* extension_of(const Texture& texture) {
  const bool is_small = std::max(texture.image.width, texture.image.height) <= small_px;
  return texture.is_srgb && !is_small && !uses_alpha(texture.image) ? ".jpg" : ".png";
}

/// Letters that a URI, a file system and a shell take as they are.
std::string plain_name(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
  return name;
}

bool is_same_picture(const Texture& a, const Texture& b) {
  return a.is_srgb == b.is_srgb && a.wrap_u == b.wrap_u && a.wrap_v == b.wrap_v &&
         a.image.width == b.image.width && a.image.height == b.image.height &&
         a.image.pixels == b.image.pixels;
}

/// The limit of a file system, in bytes; half of it is left to the name of the file that the pictures belong
/// to.
constexpr std::size_t max_file_name = 255, max_picture_stem = 120;

std::string file_name(const fs::path& file, const std::string& name) {
  const std::string back = "_" + name;
  std::string stem = plain_name(file.stem().string());
  stem.resize(std::min(stem.size(), max_file_name - back.size()));
  return stem + back;
}

/// The JSON of the .glb that is there now; empty where there is none.
std::string json_of(const fs::path& file) {
  constexpr std::uint32_t json_kind = 0x4e4f534a, max_json_bytes = 1u << 30;
  std::array<std::uint32_t, 5> head{};  // magic, version, size; size and kind of the first chunk
  const Result<std::string> front = read_front(file, sizeof head);
  if (!front || front->size() < sizeof head) return "";
  std::memcpy(head.data(), front->data(), sizeof head);
  if (head[4] != json_kind || head[3] > max_json_bytes) return "";
  const Result<std::string> json = read_front(file, sizeof head + head[3]);
  return json ? json->substr(sizeof head) : "";
}

/// Whether a picture may be written over: it is one of the file's own, or the same already.
bool is_ours(const fs::path& picture, std::string_view bytes, const std::string& json) {
  std::error_code code;
  if (!fs::exists(picture, code) || json.find('"' + picture.filename().string() + '"') != std::string::npos)
    return true;
  const Result<std::string> there = read_file(picture);
  return there && *there == bytes;
}

std::uint64_t hash_of(const Texture& texture) {
  ContentHash hash;
  hash.add(texture.is_srgb), hash.add(texture.wrap_u), hash.add(texture.wrap_v);
  hash.add(texture.image.width), hash.add(texture.image.height);
  hash.add(texture.image.pixels);
  return hash.value();
}

/// Solid glass. Its thickness is what panes of it have, and a hint for viewers that do not follow rays
/// through bodies; without any, readers would take it for a surface alone.
Json volume_json(const Material& glass) {
  constexpr float usual_thickness_m = 0.1f;
  const glm::vec3 absorption_per_m = glass.absorption_per_m;
  Json volume{{"thicknessFactor", glass.thickness_m > 0.0f ? glass.thickness_m : usual_thickness_m}};
  const float maximum = std::max({absorption_per_m.x, absorption_per_m.y, absorption_per_m.z});
  if (maximum > 0.0f) {
    volume["attenuationDistance"] = 1.0f / maximum;
    volume["attenuationColor"] = GltfChunk::array_of(glm::exp(-absorption_per_m / maximum));
  }
  return volume;
}

Image8 without_alpha(const Image8& image) {
  Image8 colour(image.width, image.height, 3);
  for (std::size_t i = 0; i < image.pixels.size() / 4; ++i)
    for (std::size_t c = 0; c < 3; ++c) colour.pixels[3 * i + c] = image.pixels[4 * i + c];
  return colour;
}

/// A picture whose longest side is `max_px` at most: colours are averaged as light, data as they are.
Image8 no_larger(const Texture& texture, int max_px) {
  const Image8& image = texture.image;
  const int longest = std::max(image.width, image.height), shortest = std::min(image.width, image.height);
  const int n = std::min((longest + max_px - 1) / max_px, shortest);
  if (n <= 1) return image;
  if (texture.is_srgb) return reduced(image, n);
  ImageF data(image.width, image.height, image.channels);
  std::copy(image.pixels.begin(), image.pixels.end(), data.pixels.begin());
  const ImageF small = reduced(data, n);
  Image8 bytes(small.width, small.height, small.channels);
  std::transform(small.pixels.begin(), small.pixels.end(), bytes.pixels.begin(),
                 [](float value) { return std::uint8_t(value + 0.5f); });
  return bytes;
}

}  // namespace

int GltfMaterialWriter::add(const Texture& texture) {
  const std::uint64_t hash = hash_of(texture);
  const auto [first, last] = textures_by_hash_.equal_range(hash);
  for (auto same = first; same != last; ++same)
    if (is_same_picture(*textures_[std::size_t(same->second)], texture)) return same->second;
  textures_by_hash_.emplace(hash, int(textures_.size()));
  const std::string stem =
      texture.name.empty() ? fmt::format("{}", textures_.size())
                           : plain_name(fs::path(texture.name).stem().string()).substr(0, max_picture_stem);
  const char* extension = extension_of(texture);
  std::string name = stem + extension;
  // Numbers go on from the last one of this name: counted from 2 each time, they took cubic time.
  for (int& number = last_number_[name]; !taken_names_.insert(name).second;)
    name = fmt::format("{}_{}{}", stem, number = std::max(number + 1, 2), extension);
  textures_.push_back(&texture);
  names_.push_back(name);
  return int(textures_.size()) - 1;
}

int GltfMaterialWriter::add(const Model& model, const std::vector<Material>& materials) {
  std::vector<int> written_textures;
  written_textures.reserve(model.textures.size());
  for (const Texture& texture : model.textures) written_textures.push_back(add(texture));
  const int first = int(materials_.size());
  for (const Material& material : materials) materials_.push_back(material_json(material, written_textures));
  return first;
}

void GltfMaterialWriter::use(const char* extension) {
  if (std::find(extensions_.begin(), extensions_.end(), extension) == extensions_.end())
    extensions_.push_back(extension);
}

Json GltfMaterialWriter::texture_info(int texture, const TextureMapping& mapping) {
  Json info{{"index", texture}};
  if (mapping.takes_second_uvs) info["texCoord"] = 1;
  const glm::mat3& m = mapping.texture_from_uv;
  if (m == glm::mat3(1.0f)) return info;
  use("KHR_texture_transform");
  const float scale_u = glm::length(glm::vec2(m[0]));
  const float scale_v = (m[0].x * m[1].y - m[0].y * m[1].x) / std::max(scale_u, 1e-20f);  // may be mirrored
  info["extensions"]["KHR_texture_transform"] = {
      {"offset", {m[2].x, m[2].y}}, {"rotation", std::atan2(-m[0].y, m[0].x)}, {"scale", {scale_u, scale_v}}};
  return info;
}

Json GltfMaterialWriter::material_json(const Material& material, const std::vector<int>& written_textures) {
  const TextureMapping base{material.texture_from_mesh_uv};
  const OwnMappings own = material.own_mappings.value_or(OwnMappings{base, base, base, base});
  const auto info = [&](int texture, const TextureMapping& mapping) {
    return texture_info(written_textures[std::size_t(texture)], mapping);
  };
  Json json{{"name", material.name}};
  Json& metal = json["pbrMetallicRoughness"];
  const glm::vec3 colour = glm::clamp(material.base_colour, glm::vec3(0.0f), glm::vec3(1.0f));
  metal["baseColorFactor"] = {colour.x, colour.y, colour.z, material.alpha};
  metal["metallicFactor"] = material.metallic;
  metal["roughnessFactor"] = material.roughness;
  if (material.base_colour_texture != no_index)
    metal["baseColorTexture"] = info(material.base_colour_texture, base);
  if (material.surface_texture != no_index)
    metal["metallicRoughnessTexture"] = info(material.surface_texture, own.surface);
  if (material.normal_texture != no_index) {
    json["normalTexture"] = info(material.normal_texture, own.normal);
    json["normalTexture"]["scale"] = material.normal_scale;
  }
  if (material.emission_texture != no_index)
    json["emissiveTexture"] = info(material.emission_texture, own.emission);
  const int occlusion =
      material.occlusion_texture != no_index ? material.occlusion_texture : material.surface_texture;
  if (occlusion != no_index && material.occlusion_strength > 0.0f) {
    json["occlusionTexture"] =
        info(occlusion, occlusion == material.occlusion_texture ? own.occlusion : own.surface);
    if (material.occlusion_strength != 1.0f)
      json["occlusionTexture"]["strength"] = material.occlusion_strength;
  }
  const float strength = std::max({material.emission.x, material.emission.y, material.emission.z, 1.0f});
  if (material.emission != glm::vec3(0.0f)) {
    json["emissiveFactor"] = GltfChunk::array_of(material.emission / strength);
    if (strength > 1.0f) {
      use("KHR_materials_emissive_strength");
      json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
    }
  }
  if (material.clear_coat > 0.0f) {
    use("KHR_materials_clearcoat");
    json["extensions"]["KHR_materials_clearcoat"] = {
        {"clearcoatFactor", material.clear_coat},
        {"clearcoatRoughnessFactor", material.clear_coat_roughness}};
  }
  if (material.refracts()) {
    for (const char* extension : {"KHR_materials_transmission", "KHR_materials_ior", "KHR_materials_volume"})
      use(extension);
    json["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1.0f}};
    json["extensions"]["KHR_materials_ior"] = {{"ior", material.ior}};
    json["extensions"]["KHR_materials_volume"] = volume_json(material);
  }
  if (material.alpha_mode == Alpha::cutout) json["alphaMode"] = "MASK";
  if (material.alpha_mode == Alpha::cutout && material.alpha_cutoff != 0.5f)
    json["alphaCutoff"] = material.alpha_cutoff;
  if (material.alpha_mode == Alpha::blend) json["alphaMode"] = "BLEND";
  if (material.is_double_sided) json["doubleSided"] = true;
  if (material.is_mirror_like) json["extras"]["parvis"]["mirror_like"] = true;
  if (material.translucency > 0.0f) json["extras"]["parvis"]["translucency"] = material.translucency;
  if (material.relief_m > 0.0f) json["extras"]["parvis"]["relief_m"] = material.relief_m;
  return json;
}

void GltfMaterialWriter::describe(Json& json, const fs::path& file) const {
  if (!materials_.empty()) json["materials"] = materials_;
  if (!extensions_.empty()) json["extensionsUsed"] = extensions_;
  constexpr int linear = 9729, trilinear = 9987;
  constexpr std::array wraps{10497, 33648, 33071};  // in the order of Wrap
  std::map<std::pair<Wrap, Wrap>, std::size_t> samplers;
  for (std::size_t i = 0; i < textures_.size(); ++i) {
    json["images"].push_back({{"uri", file_name(file, names_[i])}});
    const auto [sampler, is_new] =
        samplers.try_emplace({textures_[i]->wrap_u, textures_[i]->wrap_v}, samplers.size());
    if (is_new)
      json["samplers"].push_back({{"magFilter", linear},
                                  {"minFilter", trilinear},
                                  {"wrapS", wraps[std::size_t(textures_[i]->wrap_u)]},
                                  {"wrapT", wraps[std::size_t(textures_[i]->wrap_v)]}});
    json["textures"].push_back({{"source", i}, {"sampler", sampler->second}});
  }
}

Result<std::vector<PartialFile>> GltfMaterialWriter::write_pictures(const fs::path& file) const {
  std::vector<Result<PartialFile>> written;
  written.reserve(names_.size());
  for (const std::string& name : names_)
    written.push_back(PartialFile::create(file.parent_path() / file_name(file, name)));
  std::vector<Errors> problems(written.size());
  const std::string json_before = json_of(file);
  parallel_for(written.size(), [&](std::size_t i) {
    const Image8& image = textures_[i]->image;
    const Result<std::string> bytes =
        encode_image(uses_alpha(image) ? image : without_alpha(image), file_name(file, names_[i]));
    const fs::path picture = file.parent_path() / file_name(file, names_[i]);
    const Status status =
        !written[i] ? Status(written[i].errors())
        : !bytes    ? Status(bytes.errors())
        : !is_ours(picture, *bytes, json_before)
            ? Status(error(
                  "{}: is there already, and is no picture of an earlier {}; move it, or choose another "
                  "name",
                  picture.string(), file.filename().string()))
            : written[i]->write(*bytes);
    if (!status) problems[i] = status.errors();
  });
  Errors errors;
  std::vector<PartialFile> pictures;
  for (std::size_t i = 0; i < written.size(); ++i) {
    errors.insert(errors.end(), problems[i].begin(), problems[i].end());
    if (written[i]) pictures.push_back(*std::move(written[i]));
  }
  if (!errors.empty()) return errors;
  return pictures;
}

Result<std::vector<std::string>> GltfMaterialWriter::browser_pictures(int max_px, int min_px) const {
  std::vector<Result<std::string>> encoded(textures_.size(), std::string());
  parallel_for(textures_.size(), [&](std::size_t i) {
    const Image8& image = textures_[i]->image;
    if (std::max(image.width, image.height) <= min_px) return;
    const Image8 small = no_larger(*textures_[i], max_px);
    encoded[i] = encode_image(uses_alpha(small) ? small : without_alpha(small),
                              names_[i] + (textures_[i]->is_srgb ? ".webp" : ".png"));
  });
  std::vector<std::string> pictures;
  for (Result<std::string>& each : encoded) {
    if (!each) return each.errors();
    pictures.push_back(*std::move(each));
  }
  return pictures;
}

}  // namespace parvis::scene
