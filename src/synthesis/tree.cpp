#include "synthesis/tree.h"

#include <cassert>
#include <glm/gtc/matrix_transform.hpp>

#include "base/colour.h"
#include "synthesis/leaf_texture.h"
#include "synthesis/tree_mesh.h"

namespace parvis::synthesis {
namespace {

constexpr int bark = 0, leaf_material = 1;  // materials

/// orders: children, first, length share, angle, upward, wander, steps, sides
Species species_of(int index) {
  if (index == 0)
    return {9.5f,
            0.16f,
            {{0, 0.0f, 1.0f, 0.0f, 0.02f, 0.045f, 12, 10},
             {17, 0.36f, 0.42f, 56.0f, 0.09f, 0.10f, 7, 7},
             {9, 0.25f, 0.46f, 50.0f, 0.03f, 0.16f, 4, 5},
             {6, 0.2f, 0.52f, 46.0f, -0.02f, 0.2f, 3, 3}}};
  return {12.5f,
          0.27f,
          {{0, 0.0f, 1.0f, 0.0f, 0.01f, 0.08f, 12, 10},
           {15, 0.27f, 0.55f, 66.0f, 0.10f, 0.13f, 8, 7},
           {10, 0.22f, 0.44f, 52.0f, 0.02f, 0.18f, 4, 5},
           {6, 0.2f, 0.5f, 48.0f, -0.03f, 0.2f, 3, 3}}};
}

/// The slender one with half of its branches.
Species medium_species(float height_m) {
  return {height_m,
          0.017f * height_m,
          {{0, 0.0f, 1.0f, 0.0f, 0.02f, 0.045f, 9, 8},
           {15, 0.34f, 0.42f, 56.0f, 0.09f, 0.10f, 5, 5},
           {7, 0.25f, 0.5f, 50.0f, 0.03f, 0.16f, 3, 3}}};
}

/// A few limbs whose branches carry sprays, for places with hundreds of trees.
Species small_species(float height_m) {
  return {height_m,
          0.018f * height_m,
          {{0, 0.0f, 1.0f, 0.0f, 0.01f, 0.05f, 6, 6},
           {13, 0.24f, 0.44f, 60.0f, 0.09f, 0.12f, 4, 4},
           {7, 0.15f, 0.55f, 55.0f, 0.02f, 0.18f, 2, 3}}};
}

scene::Texture texture(std::string name, Image8 image, bool is_srgb, bool repeats) {
  scene::Texture result;
  result.name = std::move(name), result.image = std::move(image), result.is_srgb = is_srgb,
  result.set_repeats(repeats);
  return result;
}

void add_material(scene::Model& model, const std::string& name, SurfacePictures pictures, bool repeats) {
  scene::Material m;
  m.name = name, m.roughness = 1.0f, m.metallic = 0.0f;
  m.base_colour_texture = int(model.textures.size());
  m.normal_texture = m.base_colour_texture + 1, m.surface_texture = m.base_colour_texture + 2;
  model.textures.push_back(texture(name, std::move(pictures.colour), true, repeats));
  model.textures.push_back(texture(name + "_normal", std::move(pictures.normal), false, repeats));
  model.textures.push_back(texture(name + "_surface", std::move(pictures.surface), false, repeats));
  model.materials.push_back(std::move(m));
}

/// Bark, and behind it leaves.
void add_materials(scene::Model& model, glm::vec3 green, Random& random) {
  add_material(model, "bark", bark_pictures(linear_from_srgb8(0x8C, 0x80, 0x70), random.next()), true);
  add_material(model, "leaves", leaf_pictures(green, random.next()), false);
  scene::Material& leaf = model.materials.back();
  leaf.alpha_mode = scene::Alpha::cutout, leaf.is_double_sided = true, leaf.translucency = 0.55f;
}

void add_part(scene::Model& model, const char* name, Mesh mesh, int material) {
  scene::Part part;
  part.object = name, part.mesh = std::move(mesh), part.material = material;
  model.parts.push_back(std::move(part));
}

}  // namespace

scene::Model make_tree(int species_index, std::uint64_t seed) {
  Random random(seed, 100 + std::uint64_t(species_index));
  const Species species = species_of(species_index);
  const std::vector<Branch> tree = grow_tree(species, random);
  Mesh wood;
  for (const Branch& branch : tree) add_tube(wood, branch, species.orders[std::size_t(branch.order)].sides);
  assert(wood.triangle_count() < tree_triangles && wood.triangle_count() % 2 == 0);
  const glm::vec3 crown_middle(0.0f, 0.0f, 0.55f * species.height_m);
  const Sprays sprays{(tree_triangles - wood.triangle_count()) / 2, 0.34f};
  Mesh green = foliage(tree, sprays, crown_middle, random);

  scene::Model model;
  model.name = species_index == 0 ? "street_tree" : "park_tree";
  add_materials(
      model, species_index == 0 ? linear_from_srgb8(0x86, 0xA4, 0x4C) : linear_from_srgb8(0x76, 0x98, 0x46),
      random);
  add_part(model, "wood", std::move(wood), bark);
  add_part(model, "foliage", std::move(green), leaf_material);
  return model;
}

scene::Model make_medium_tree(float height_m, std::uint64_t seed) {
  constexpr std::size_t sprays = 3600;
  constexpr int green_of[][3] = {{0x7C, 0x9A, 0x48}, {0x70, 0x92, 0x44}, {0x86, 0xA0, 0x4A}};
  Random random(seed, 150);
  const Species species = medium_species(height_m * random.uniform(0.9f, 1.1f));
  const std::vector<Branch> tree = grow_tree(species, random);
  Mesh wood;
  for (const Branch& branch : tree) add_tube(wood, branch, species.orders[std::size_t(branch.order)].sides);
  const int* green = green_of[random.index(3)];
  scene::Model model;
  model.name = "medium_tree";
  add_materials(model, linear_from_srgb8(green[0], green[1], green[2]), random);
  add_part(model, "wood", std::move(wood), bark);
  add_part(model, "foliage",
           foliage(tree, {sprays, 0.042f * height_m}, {0.0f, 0.0f, 0.55f * height_m}, random), leaf_material);
  return model;
}

void plant_small_trees(scene::Model& model, std::span<const TreeSpot> places, std::uint64_t seed) {
  if (places.empty()) return;
  Random random(seed, 200);
  const int first_material = int(model.materials.size());
  add_materials(model, linear_from_srgb8(0x68, 0x88, 0x42), random);
  Mesh wood, green;
  for (const TreeSpot& place : places) {
    const Species species = small_species(place.height_m);
    const std::vector<Branch> tree = grow_tree(species, random);
    Mesh own_wood;
    for (const Branch& branch : tree)
      if (branch.order < leaf_bearing_order)
        add_tube(own_wood, branch, species.orders[std::size_t(branch.order)].sides);
    const Sprays sprays{460, 0.075f * place.height_m};
    const Mesh own_green = foliage(tree, sprays, {0.0f, 0.0f, 0.55f * place.height_m}, random);
    append(wood, own_wood, glm::translate(glm::mat4(1.0f), place.foot));
    append(green, own_green, glm::translate(glm::mat4(1.0f), place.foot));
  }
  add_part(model, "tree wood", std::move(wood), first_material + bark);
  add_part(model, "tree leaves", std::move(green), first_material + leaf_material);
}

}  // namespace parvis::synthesis
