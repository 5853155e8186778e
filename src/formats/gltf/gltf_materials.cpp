#include "formats/gltf/gltf_materials.h"

#include <cmath>
#include <map>
#include <mutex>

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
  MaterialReader(const GltfFile& file, Model& model, Errors& warnings)
      : file_(file), model_(model), warnings_(warnings) {}

  void read_materials() {
    for (const Json& source : file_.list("materials")) model_.materials.push_back(material(source));
    model_.materials.emplace_back().name = "default";
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

 private:
  /// The model's texture for a textureInfo: one for each pair of glTF texture and colour space.
  int texture(const Json& info, bool is_srgb, Material& material) {
    const int gltf_texture = file_.index(info, "index", "textures");
    if (gltf_texture < 0) return no_index;
    const Json& transform = gltf_extension(info, "KHR_texture_transform");
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
    m.base_colour_texture = texture(gltf_member(metal, "baseColorTexture"), true, m);
    m.surface_texture = texture(gltf_member(metal, "metallicRoughnessTexture"), false, m);
    m.normal_texture = texture(gltf_member(source, "normalTexture"), false, m);
    m.normal_scale = gltf_number(gltf_member(source, "normalTexture"), "scale", 1.0f);
    m.emission_texture = texture(gltf_member(source, "emissiveTexture"), true, m);
    m.emission =
        gltf_vector<3>(source, "emissiveFactor", glm::vec3(0.0f)) *
        gltf_number(gltf_extension(source, "KHR_materials_emissive_strength"), "emissiveStrength", 1.0f);
    const Json& coat = gltf_extension(source, "KHR_materials_clearcoat");
    m.clear_coat = gltf_number(coat, "clearcoatFactor", 0.0f);
    m.clear_coat_roughness = gltf_number(coat, "clearcoatRoughnessFactor", 0.0f);
    const std::string mode = source.value("alphaMode", "OPAQUE");
    m.alpha_mode = mode == "MASK" ? Alpha::cutout : mode == "BLEND" ? Alpha::blend : Alpha::opaque;
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
    } catch (const GltfFile::GltfProblem& problem) {
      return error("{}", problem.message);
    } catch (const Json::exception& problem) {
      return error("{}: {}", name, json_reason(problem.what()));
    }
  }

  const GltfFile& file_;
  Model& model_;
  Errors& warnings_;
  std::map<std::pair<int, bool>, int> textures_;  ///< (glTF texture, is sRGB) to the model's texture
  std::vector<int> images_;                       ///< of each of the model's textures
};

}  // namespace

void read_materials(const GltfFile& file, Model& model, Errors& warnings) {
  MaterialReader reader(file, model, warnings);
  reader.read_materials();
  reader.read_pictures();
}

}  // namespace parvis::scene
