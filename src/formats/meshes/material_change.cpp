#include "formats/meshes/material_change.h"

#include <algorithm>
#include <map>
#include <utility>

#include "scene/data/part_division.h"

namespace parvis::scene {
namespace {

template <class T>
void override_with(T& value, const std::optional<T>& change) {
  if (change) value = *change;
}

Material changed(Material material, const MaterialChange& change, const std::string& name) {
  material.name = name;
  if (change.colour) {
    material.base_colour = *change.colour;
    material.base_colour_texture = no_index;
    if (material.alpha_mode == Alpha::cutout) material.alpha_mode = Alpha::opaque;  // the picture's holes
  }
  if (change.roughness || change.metallic) material.surface_texture = no_index;
  override_with(material.roughness, change.roughness);
  override_with(material.metallic, change.metallic);
  override_with(material.clear_coat, change.clear_coat);
  if (change.alpha) {
    material.alpha = *change.alpha;
    material.alpha_mode = material.alpha < 1.0f ? Alpha::blend : Alpha::opaque;
  }
  if (change.emission) {
    material.emission = *change.emission;
    material.emission_texture = no_index;
  }
  if (change.metallic && !change.ior) material.ior = 1.0f;  // another surface than glass
  if (change.ior) {
    material.ior = *change.ior;
    material.alpha_mode = Alpha::opaque;  // what lies behind it is computed, not blended
    material.is_double_sided = false;
    material.is_mirror_like = true;
    if (!change.colour && material.refracts())  // glass has none of its own; where it is open, panes would
      material.base_colour = glm::vec3(1.0f);
  }
  override_with(material.absorption_per_m, change.absorption_per_m);
  override_with(material.is_mirror_like, change.is_mirror_like);
  return material;
}

std::vector<bool> triangles_in(std::span<const MaterialMask> masks, const Model& model, const Part& part) {
  std::vector<bool> is_taken(part.mesh.triangle_count());
  for (std::size_t triangle = 0; triangle < is_taken.size(); ++triangle)
    is_taken[triangle] =
        masks.empty() || std::any_of(masks.begin(), masks.end(), [&](const MaterialMask& mask) {
          return lies_in(mask, model, part, triangle);
        });
  return is_taken;
}

/// The materials inside and outside of the masks.
struct Sides {
  int inside, outside;
};

Sides add_sides(Model& model, int old, std::span<const MaterialMask> masks, const MaterialChange& change,
                const std::string& name) {
  const Material before = model.materials[std::size_t(old)];
  Material inside = changed(before, change, name);
  Sides sides{int(model.materials.size()), old};
  const bool picture_is_pure =
      before.base_colour_texture != no_index && before.base_colour == glm::vec3(1.0f);
  if (!change.colour || masks.empty() || !picture_is_pure) {
    model.materials.push_back(std::move(inside));
    return sides;
  }
  Texture picture = model.textures[std::size_t(before.base_colour_texture)];
  picture.image = painted(picture.image, masks, *change.colour);
  picture.name += " with " + name;
  Material outside = before;
  outside.base_colour_texture = inside.base_colour_texture = int(model.textures.size());
  inside.base_colour = glm::vec3(1.0f);
  model.textures.push_back(std::move(picture));
  model.materials.push_back(std::move(inside));
  sides.outside = int(model.materials.size());
  model.materials.push_back(std::move(outside));
  return sides;
}

}  // namespace

std::span<const MaterialPreset> material_presets() {
  static const std::vector<MaterialPreset> presets{
      {"paint",
       "car paint under clear lacquer; keeps the picture's colours",
       {.roughness = 0.45f, .metallic = 0.0f, .clear_coat = 1.0f, .is_mirror_like = true}},
      {"metallic_paint",
       "car paint with flakes under clear lacquer; keeps the picture's colours",
       {.roughness = 0.35f, .metallic = 0.6f, .clear_coat = 1.0f, .is_mirror_like = true}},
      {"glass",
       "a dark, tinted pane that mirrors",
       {.colour = glm::vec3(0.012f, 0.014f, 0.015f),
        .roughness = 0.02f,
        .metallic = 0.0f,
        .clear_coat = 0.0f,
        .is_mirror_like = true}},
      {"clear_glass",
       "a pane that one sees through",
       {.colour = glm::vec3(0.02f),
        .roughness = 0.02f,
        .metallic = 0.0f,
        .clear_coat = 0.0f,
        .alpha = 0.25f,
        .is_mirror_like = true}},
      {"solid_glass",
       "a closed body of clear glass that refracts light: a ball, a lens, a paperweight; where it is open, a "
       "pane",
       {.roughness = 0.0f, .metallic = 0.0f, .clear_coat = 0.0f, .ior = 1.5f, .is_mirror_like = true}},
      {"lamp",
       "the picture's colours behind clear glass",
       {.roughness = 0.3f, .metallic = 0.0f, .clear_coat = 1.0f, .is_mirror_like = true}},
      {"chrome",
       "polished metal",
       {.colour = glm::vec3(0.80f, 0.81f, 0.83f),
        .roughness = 0.04f,
        .metallic = 1.0f,
        .clear_coat = 0.0f,
        .is_mirror_like = true}},
      {"steel",
       "brushed metal",
       {.colour = glm::vec3(0.56f, 0.57f, 0.58f), .roughness = 0.35f, .metallic = 1.0f, .clear_coat = 0.0f}},
      {"plastic",
       "dull plastic; keeps the picture's colours",
       {.roughness = 0.55f, .metallic = 0.0f, .clear_coat = 0.0f, .is_mirror_like = false}},
      {"rubber",
       "tyres and seals",
       {.colour = glm::vec3(0.045f),
        .roughness = 0.9f,
        .metallic = 0.0f,
        .clear_coat = 0.0f,
        .is_mirror_like = false}}};
  return presets;
}

MaterialChange merged(const MaterialChange& under, const MaterialChange& over) {
  const auto either = [](const auto& first, const auto& second) { return first ? first : second; };
  return {either(over.colour, under.colour),
          either(over.roughness, under.roughness),
          either(over.metallic, under.metallic),
          either(over.clear_coat, under.clear_coat),
          either(over.alpha, under.alpha),
          either(over.emission, under.emission),
          either(over.ior, under.ior),
          either(over.absorption_per_m, under.absorption_per_m),
          either(over.is_mirror_like, under.is_mirror_like)};
}

std::size_t change_material(Model& model, std::span<const std::size_t> parts,
                            std::span<const MaterialMask> masks, const MaterialChange& change,
                            const std::string& name) {
  std::map<int, Sides> sides_of;  // for each material in use
  std::size_t changed_triangles = 0;
  for (const std::size_t index : parts) {
    const std::vector<bool> is_taken = triangles_in(masks, model, model.parts[index]);
    const std::size_t count = std::size_t(std::count(is_taken.begin(), is_taken.end(), true));
    changed_triangles += count;
    if (count == 0) continue;

    const int old = model.parts[index].material;
    if (!sides_of.count(old)) sides_of[old] = add_sides(model, old, masks, change, name);
    const Sides sides = sides_of[old];
    if (count < is_taken.size()) {
      Part inside = split_off(model.parts[index], is_taken);
      Part outside = std::exchange(model.parts[index], std::move(inside));
      outside.material = sides.outside;
      model.parts.push_back(std::move(outside));
    }
    model.parts[index].material = sides.inside;
  }
  return changed_triangles;
}

}  // namespace parvis::scene
