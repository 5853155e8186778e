#include "formats/gltf/gltf_materials.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <span>

#include "base/image_io.h"
#include "base/json_guard.h"
#include "base/parallel.h"
#include "formats/gltf/gltf_values.h"
#include "scene/data/placeholder.h"

namespace parvis::scene {
namespace {

using Json = GltfFile::Json;

class MaterialReader {
 public:
  MaterialReader(const GltfFile& file, Model& model, FileAccount& account, Errors& warnings)
      : file_(file), model_(model), account_(account), warnings_(warnings) {}

  std::vector<UvSets> read_materials() {
    std::vector<UvSets> sets;
    for (const Json& source : file_.list("materials")) {
      model_.materials.push_back(material(source));
      sets.push_back(settle_mappings(model_.materials.back()));
    }
    model_.materials.emplace_back().name = "default";
    sets.emplace_back();
    account_.used("materials", file_.list("materials").size());
    return sets;
  }

  void read_pictures() {
    std::mutex mutex;
    parallel_for(model_.textures.size(), [&](std::size_t i) {
      Texture& texture = model_.textures[i];
      Result<Image8> picture = read_picture(images_[i], texture.name);
      const std::scoped_lock lock(mutex);
      if (picture) {
        texture.image = has_edges_[i] != 0 ? enlarged(*picture) : *std::move(picture);
        account_.used("images");
        return;
      }
      texture.image = placeholder_picture();
      account_.left_out("images", "a checker stands for them", texture.name);
      for (const Error& problem : picture.errors())
        warnings_.push_back({problem.message + "; a checker stands for it", {file_.path().string(), 0, 0}});
    });
  }

 private:
  /// A texture of the material that is read, and how it lies on the mesh.
  struct Lying {
    int Material::*texture;
    TextureMapping OwnMappings::*mapping;  ///< null of the base colour's
    glm::mat3 texture_from_uv;
    int set;  ///< of texture coordinates
  };

  /// The model's texture for a textureInfo: one for each pair of glTF texture and colour space.
  void read_texture(const Json& info, bool is_srgb, Material& material, int Material::*texture,
                    TextureMapping OwnMappings::*mapping) {
    material.*texture = model_texture(info, is_srgb);
    if (material.*texture == no_index) return;
    const Json& transform = gltf_extension(info, "KHR_texture_transform");
    lying_.push_back({texture, mapping, transform.empty() ? glm::mat3(1.0f) : texture_transform(transform),
                      transform.value("texCoord", info.value("texCoord", 0))});
  }

  /// Two sets of texture coordinates are kept; a texture that takes a third one is left out.
  UvSets settle_mappings(Material& material) {
    UvSets sets;
    if (lying_.empty()) return sets;
    sets.first = lying_.front().set;  // the base colour's, where it has a texture
    material.texture_from_mesh_uv = lying_.front().texture_from_uv;
    OwnMappings own;
    bool differs = false;
    for (const Lying& lying : lying_) {
      if (lying.set != sets.first && sets.second < 0) sets.second = lying.set;
      if (lying.set != sets.first && lying.set != sets.second) {
        material.*lying.texture = no_index;
        account_.left_out("textures", "a material takes more than two sets of texture coordinates",
                          material.name);
        continue;
      }
      const TextureMapping mapping{lying.texture_from_uv, lying.set != sets.first};
      differs |= mapping.takes_second_uvs || mapping.texture_from_uv != material.texture_from_mesh_uv;
      if (lying.mapping != nullptr) own.*lying.mapping = mapping;
    }
    if (differs) material.own_mappings = own, material.relief_m = 0.0f;
    lying_.clear();
    return sets;
  }

  /// The picture of a texture: that of an extension whose format is read, else the one that all readers know.
  int image_of(const Json& texture) {
    for (const char* read : {"EXT_texture_webp", "EXT_texture_avif"})
      if (const int image = file_.index(gltf_extension(texture, read), "source", "images"); image >= 0)
        return image;
    const int plain = file_.index(texture, "source", "images");
    for (const char* unread : {"KHR_texture_basisu", "MSFT_texture_dds"}) {
      const int image = file_.index(gltf_extension(texture, unread), "source", "images");
      if (image < 0) continue;
      if (plain < 0) return image;
      account_.changed("textures", fmt::format("a plain picture stands for that of {}", unread));
    }
    return plain;
  }

  Wrap wrap_of(int sampler, const char* axis) const {
    constexpr int clamp_to_edge = 33071, mirrored_repeat = 33648, repeat = 10497;
    if (sampler < 0) return Wrap::repeat;
    const int wrap = file_.list("samplers")[std::size_t(sampler)].value(axis, repeat);
    return wrap == clamp_to_edge ? Wrap::clamp : wrap == mirrored_repeat ? Wrap::mirror : Wrap::repeat;
  }

  int model_texture(const Json& info, bool is_srgb) {
    const int gltf_texture = file_.index(info, "index", "textures");
    if (gltf_texture < 0) return no_index;
    const auto [place, is_new] = textures_.try_emplace({gltf_texture, is_srgb}, int(model_.textures.size()));
    if (!is_new) return place->second;
    const Json& description = file_.list("textures")[std::size_t(gltf_texture)];
    const int sampler = file_.index(description, "sampler", "samplers");
    model_.textures.push_back({"", {}, is_srgb, wrap_of(sampler, "wrapS"), wrap_of(sampler, "wrapT")});
    images_.push_back(image_of(description));
    constexpr int nearest = 9728;
    has_edges_.push_back(
        sampler >= 0 && file_.list("samplers")[std::size_t(sampler)].value("magFilter", 0) == nearest ? 1
                                                                                                      : 0);
    return place->second;
  }

  /// Textures are drawn smooth. Of a small picture whose texels are to have edges each becomes a square.
  static Image8 enlarged(const Image8& picture) {
    constexpr int enough_px = 256;
    const int n = std::max(1, enough_px / std::max({picture.width, picture.height, 1}));
    Image8 large(n * picture.width, n * picture.height, picture.channels);
    for (int y = 0; y < large.height; ++y)
      for (int x = 0; x < large.width; ++x)
        std::copy_n(picture.at(x / n, y / n), picture.channels, large.at(x, y));
    return large;
  }

  static glm::mat3 texture_transform(const Json& transform) {
    const glm::vec2 offset = gltf_vector<2>(transform, "offset", glm::vec2(0.0f));
    const glm::vec2 scale = gltf_vector<2>(transform, "scale", glm::vec2(1.0f));
    const float angle = gltf_number(transform, "rotation", 0.0f), c = std::cos(angle), s = std::sin(angle);
    // KHR_texture_transform: translation * rotation * scale, counter-clockwise with v downward
    return glm::mat3(1, 0, 0, 0, 1, 0, offset.x, offset.y, 1) * glm::mat3(c, -s, 0, s, c, 0, 0, 0, 1) *
           glm::mat3(scale.x, 0, 0, 0, scale.y, 0, 0, 0, 1);
  }

  Material material(const Json& source) {
    Material m;
    m.name = source.value("name", "");
    const Json& metal = gltf_member(source, "pbrMetallicRoughness");
    const glm::vec4 base = gltf_vector<4>(metal, "baseColorFactor", glm::vec4(1.0f));
    m.base_colour = glm::vec3(base);
    m.alpha = base.w;
    m.metallic = gltf_number(metal, "metallicFactor", 1.0f);
    m.roughness = gltf_number(metal, "roughnessFactor", 1.0f);
    read_older_look(source, m);
    read_texture(gltf_member(metal, "baseColorTexture"), true, m, &Material::base_colour_texture, nullptr);
    read_texture(gltf_member(metal, "metallicRoughnessTexture"), false, m, &Material::surface_texture,
                 &OwnMappings::surface);
    read_texture(gltf_member(source, "normalTexture"), false, m, &Material::normal_texture,
                 &OwnMappings::normal);
    m.normal_scale = gltf_number(gltf_member(source, "normalTexture"), "scale", 1.0f);
    read_texture(gltf_member(source, "emissiveTexture"), true, m, &Material::emission_texture,
                 &OwnMappings::emission);
    read_occlusion(gltf_member(source, "occlusionTexture"), m);
    m.emission =
        gltf_vector<3>(source, "emissiveFactor", glm::vec3(0.0f)) *
        gltf_number(gltf_extension(source, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0f);
    const Json& coat = gltf_extension(source, "KHR_materials_clearcoat");
    m.clear_coat = gltf_number(coat, "clearcoatFactor", 0.0f);
    m.clear_coat_roughness = gltf_number(coat, "clearcoatRoughnessFactor", 0.0f);
    const std::string mode = source.value("alphaMode", "OPAQUE");
    m.alpha_mode = mode == "MASK" ? Alpha::cutout : mode == "BLEND" ? Alpha::blend : Alpha::opaque;
    const float cutoff = gltf_number(source, "alphaCutoff", 0.5f);
    if (cutoff > 0.0f)
      m.alpha_cutoff = cutoff;
    else if (m.alpha_mode == Alpha::cutout)
      m.alpha_mode = Alpha::opaque;  // nothing lies below it
    m.is_double_sided = source.value("doubleSided", false);
    const Json& parvis = gltf_member(gltf_member(source, "extras"), "parvis");
    m.translucency = gltf_number(parvis, "translucency", 0.0f);
    m.relief_m = gltf_number(parvis, "relief_m", 0.0f);
    m.is_mirror_like = parvis.value("mirror_like", false);
    if (gltf_number(gltf_extension(source, "KHR_materials_transmission"), "transmissionFactor", 0.0f) <= 0.5f)
      return m;
    m.is_mirror_like = true;
    const Json& volume = gltf_extension(source, "KHR_materials_volume");
    if (gltf_number(volume, "thicknessFactor", 0.0f) > 0.0f)
      make_solid(m, gltf_extension(source, "KHR_materials_ior"), volume);
    if (!m.refracts()) m.base_colour *= 0.1f;  // panes are shown dark and mirroring, as they look by day
    return m;
  }

  /// Looks without metals, which stand in place of that of the standard.
  void read_older_look(const Json& source, Material& m) {
    const Json& extensions = gltf_member(source, "extensions");
    const Json& older = gltf_member(extensions, "KHR_materials_pbrSpecularGlossiness");
    if (!older.empty() && !source.contains("pbrMetallicRoughness")) {
      const glm::vec4 diffuse = gltf_vector<4>(older, "diffuseFactor", glm::vec4(1.0f));
      m.base_colour = glm::vec3(diffuse), m.alpha = diffuse.w, m.metallic = 0.0f;
      m.roughness = 1.0f - gltf_number(older, "glossinessFactor", 1.0f);
      read_texture(gltf_member(older, "diffuseTexture"), true, m, &Material::base_colour_texture, nullptr);
      account_.changed("colours of highlights", "those of materials without metals are white", m.name);
    }
    if (extensions.contains("KHR_materials_unlit")) m.metallic = 0.0f, m.roughness = 1.0f;
  }

  /// Ambient occlusion: the red of the surface texture where the file says that it is the same, else a
  /// texture of its own. Without any, the red of the surface texture means nothing.
  void read_occlusion(const Json& info, Material& m) {
    m.occlusion_strength = 0.0f;
    if (info.empty()) return;
    m.occlusion_strength = gltf_number(info, "strength", 1.0f);
    read_texture(info, false, m, &Material::occlusion_texture, &OwnMappings::occlusion);
    if (m.occlusion_texture == no_index || m.occlusion_texture != m.surface_texture) return;
    const Lying& occlusion = lying_.back();
    const auto surface = std::ranges::find(lying_, &Material::surface_texture, &Lying::texture);
    if (surface == lying_.end() || surface->set != occlusion.set ||
        surface->texture_from_uv != occlusion.texture_from_uv)
      return;
    m.occlusion_texture = no_index;
    lying_.pop_back();
  }

  /// A body of glass, as against a pane.
  void make_solid(Material& m, const Json& ior, const Json& volume) {
    constexpr float usual_ior = 1.5f, max_ior = 4.0f;
    m.ior = gltf_number(ior, "ior", usual_ior);
    if (!(m.ior >= 1.0f && m.ior <= max_ior)) {
      warnings_.push_back({fmt::format("material \"{}\": its index of refraction is {}; expected 1 to {}; {} "
                                       "stands for it",
                                       m.name, m.ior, max_ior, usual_ior),
                           {file_.path().string(), 0, 0}});
      m.ior = usual_ior;
    }
    m.alpha_mode = Alpha::opaque, m.is_double_sided = false;
    m.thickness_m = gltf_number(volume, "thicknessFactor", m.thickness_m);
    const glm::vec3 left = gltf_vector<3>(volume, "attenuationColor", glm::vec3(1.0f));
    const float distance_m = gltf_number(volume, "attenuationDistance", 0.0f);  // absent: infinitely far
    if (distance_m > 0.0f)
      m.absorption_per_m = -glm::log(glm::clamp(left, glm::vec3(1e-6f), glm::vec3(1.0f))) / distance_m;
  }

  static Result<Image8> decoded(std::span<const std::uint8_t> bytes, const std::string& name) {
    constexpr std::string_view ktx2 = "\xabKTX 20\xbb";
    const std::string_view front(reinterpret_cast<const char*>(bytes.data()),
                                 std::min(bytes.size(), ktx2.size()));
    if (front == ktx2)
      return error("{}: pictures as KTX2 are not decoded; export the model with pictures as PNG or JPEG",
                   name);
    return read_image8(bytes, name);
  }

  Result<Image8> read_picture(int image, std::string& name) const {
    if (image < 0) return error("a texture without a picture");
    const Json& description = file_.list("images")[std::size_t(image)];
    name = description.value("uri", description.value("name", fmt::format("image {}", image)));
    if (name.starts_with("data:")) name = fmt::format("image {}", image);
    try {
      if (const int view = file_.index(description, "bufferView", "bufferViews"); view >= 0)
        return decoded(file_.buffer_view(view), name);
      return decoded(file_.resource(description.value("uri", "")), name);
    } catch (const GltfFile::GltfProblem& problem) {
      return error("{}", problem.message);
    } catch (const Json::exception& problem) {
      return error("{}: {}", name, json_reason(problem.what()));
    }
  }

  const GltfFile& file_;
  Model& model_;
  FileAccount& account_;
  Errors& warnings_;
  std::vector<Lying> lying_;                      ///< the textures of the material that is read
  std::map<std::pair<int, bool>, int> textures_;  ///< (glTF texture, is sRGB) to the model's texture
  std::vector<int> images_;                       ///< of each of the model's textures
  std::vector<char> has_edges_;                   ///< whether its texels are to be seen (NEAREST)
};

}  // namespace

std::vector<UvSets> read_materials(const GltfFile& file, Model& model, FileAccount& account,
                                   Errors& warnings) {
  MaterialReader reader(file, model, account, warnings);
  std::vector<UvSets> sets = reader.read_materials();
  reader.read_pictures();
  return sets;
}

}  // namespace parvis::scene
