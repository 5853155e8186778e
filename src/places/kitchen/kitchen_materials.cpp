#include "places/kitchen/kitchen_materials.h"

#include <array>
#include <functional>
#include <string>
#include <utility>

#include "base/colour.h"
#include "base/parallel.h"
#include "places/kitchen/kitchen_light.h"
#include "places/kitchen/kitchen_textures.h"

namespace parvis::kitchen {
namespace {

struct Sheet {
  KitchenMaterial material;
  const char* name;
  glm::vec2 size_m;  ///< that the picture covers; 0: it covers the part's own coordinates once
  std::function<synthesis::SurfacePictures(std::uint32_t seed)> paint;
};

std::vector<Sheet> sheets() {
  using enum KitchenMaterial;
  return {{tiles, "tiles", {tiled_m[0], tiled_m[1]}, wall_tile_pictures},
          {floor, "floor", glm::vec2(floor_sheet_m), floor_pictures},
          {worktop, "worktop", {worktop_m[0], worktop_m[1]}, worktop_pictures},
          {front, "front", glm::vec2(front_sheet_m), front_pictures},
          {wood, "wood", glm::vec2(wood_sheet_m), wood_pictures},
          {cloth, "cloth", glm::vec2(cloth_sheet_m), cloth_pictures},
          {orange, "orange", glm::vec2(0.0f), orange_pictures},
          {apple, "apple", glm::vec2(0.0f), apple_pictures},
          {banana, "banana", glm::vec2(0.0f), banana_pictures}};
}

scene::Material plain(const char* name, glm::vec3 colour, float roughness) {
  scene::Material m;
  m.name = name, m.base_colour = colour, m.roughness = roughness;
  return m;
}

scene::Material glazed(scene::Material m) {
  m.clear_coat = 1.0f, m.clear_coat_roughness = 0.12f;
  return m;
}

/// A material that light from outside does not pass, but that hides no sky: the sky's picture is the light of
/// the room (kitchen_light.h), and walls would keep it off. Cut-outs without holes are that.
scene::Material room_shell(scene::Material m) {
  m.alpha_mode = scene::Alpha::cutout, m.is_double_sided = true;
  return m;
}

/// All materials in the order of KitchenMaterial.
std::vector<scene::Material> all_materials() {
  const glm::vec3 white(1.0f);
  std::vector<scene::Material> all{glazed(plain("tiles", white, 1.0f)),
                                   room_shell(plain("plaster", linear_from_srgb8(0xEF, 0xE6, 0xD2), 0.95f)),
                                   room_shell(plain("ceiling", linear_from_srgb8(0xF0, 0xEE, 0xE8), 0.95f)),
                                   plain("floor", white, 1.0f),
                                   plain("worktop", white, 1.0f),
                                   plain("front", white, 1.0f),
                                   plain("wood", white, 1.0f),
                                   plain("cloth", white, 1.0f),
                                   plain("frame", linear_from_srgb8(0xEA, 0xE8, 0xE0), 0.5f),
                                   plain("black", glm::vec3(0.022f), 0.35f),
                                   glazed(plain("hob", glm::vec3(0.012f), 0.4f)),
                                   room_shell(plain("view", glm::vec3(0.0f), 1.0f)),
                                   plain("orange", white, 1.0f),
                                   plain("lemon", linear_from_srgb8(0xE8, 0xC8, 0x28), 0.45f),
                                   glazed(plain("apple", white, 1.0f)),
                                   plain("pear", linear_from_srgb8(0xB4, 0xB0, 0x3C), 0.5f),
                                   plain("banana", white, 1.0f),
                                   plain("stalk", linear_from_srgb8(0x5A, 0x46, 0x2C), 0.9f),
                                   glazed(plain("china", linear_from_srgb8(0xEC, 0xEA, 0xE4), 0.5f)),
                                   glazed(plain("blue", linear_from_srgb8(0x24, 0x4C, 0x86), 0.5f)),
                                   plain("clay", linear_from_srgb8(0xB2, 0x6A, 0x48), 0.9f),
                                   glazed(plain("honey", linear_from_srgb8(0xC0, 0x6C, 0x18), 0.4f)),
                                   plain("shade", glm::vec3(0.0f), 1.0f)};
  all[std::size_t(KitchenMaterial::shade)].alpha_mode = scene::Alpha::blend;
  return all;
}

int add_texture(scene::Model& model, std::string name, Image8 image, bool is_srgb, bool repeats = true) {
  scene::Texture texture;
  texture.name = std::move(name), texture.image = std::move(image);
  texture.is_srgb = is_srgb, texture.set_repeats(repeats);
  model.textures.push_back(std::move(texture));
  return int(model.textures.size()) - 1;
}

}  // namespace

void add_kitchen_materials(scene::Model& model, std::uint64_t seed) {
  model.materials = all_materials();
  const std::vector<Sheet> all = sheets();
  std::vector<synthesis::SurfacePictures> painted(all.size());
  parallel_for(all.size(), [&](std::size_t i) { painted[i] = all[i].paint(std::uint32_t(seed * 97 + i)); });
  for (std::size_t i = 0; i < all.size(); ++i) {
    scene::Material& m = model.materials[std::size_t(all[i].material)];
    const std::string name = all[i].name;
    m.metallic = 1.0f;  // a factor of the picture, as roughness is
    m.base_colour_texture = add_texture(model, name, std::move(painted[i].colour), true);
    m.normal_texture = add_texture(model, name + "_normal", std::move(painted[i].normal), false);
    m.surface_texture = add_texture(model, name + "_surface", std::move(painted[i].surface), false);
    if (all[i].size_m.x > 0.0f)
      m.texture_from_mesh_uv = glm::mat3(1.0f / all[i].size_m.x, 0, 0, 0, 1.0f / all[i].size_m.y, 0, 0, 0, 1);
  }
  scene::Material& shade = model.materials[std::size_t(KitchenMaterial::shade)];
  shade.base_colour_texture = add_texture(model, "shade", shade_picture(), true, false);
  scene::Material& view = model.materials[std::size_t(KitchenMaterial::view)];
  view.emission_texture = add_texture(model, "view", window_view_picture(seed), true, false);
  view.emission = glm::vec3(window_view_radiance);
}

void add_part(scene::Model& model, const char* name, Mesh mesh, KitchenMaterial material) {
  scene::Part part;
  part.object = name, part.mesh = std::move(mesh), part.material = int(material);
  part.casts_shadow = material != KitchenMaterial::shade && material != KitchenMaterial::view;
  model.parts.push_back(std::move(part));
}

}  // namespace parvis::kitchen
