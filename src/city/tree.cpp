#include "city/tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/colour.h"
#include "city/leaf_texture.h"
#include "city/tree_skeleton.h"

namespace parvis::city {
namespace {

constexpr int bark = 0, leaves = 1;  // materials
constexpr int leaf_bearing_order = 2;

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

/// Unit vectors across a branch at point i.
std::array<glm::vec3, 2> cross_section(const Branch& branch, std::size_t i) {
  const std::size_t last = branch.points.size() - 1;
  const glm::vec3 axis =
      glm::normalize(branch.points[std::min(i + 1, last)] - branch.points[i > 0 ? i - 1 : 0]);
  const glm::vec3 side = glm::normalize(glm::cross(axis, glm::vec3(0.31f, 0.87f, 0.12f)));
  return {side, glm::cross(axis, side)};
}

/// A tube round a branch with smooth normals; the trunk flares at its foot.
void add_tube(Mesh& mesh, const Branch& branch, int sides) {
  const auto first = std::uint32_t(mesh.positions.size());
  float along_m = 0.0f;
  for (std::size_t i = 0; i < branch.points.size(); ++i) {
    const auto [side, other] = cross_section(branch, i);
    const bool flares = branch.order == 0 && i == 0;
    if (i > 0) along_m += glm::length(branch.points[i] - branch.points[i - 1]);
    for (int k = 0; k <= sides; ++k) {
      const float angle = 6.2831853f * float(k) / float(sides);
      const glm::vec3 out = std::cos(angle) * side + std::sin(angle) * other;
      mesh.positions.push_back(branch.points[i] + branch.radii_m[i] * (flares ? 1.7f : 1.0f) * out);
      mesh.normals.push_back(out);
      mesh.uvs.push_back(
          {float(k) / float(sides) * (branch.order == 0 ? 1.0f : 0.5f), -0.5f * along_m / bark_sheet_m});
    }
  }
  const auto row = std::uint32_t(sides + 1);
  for (std::uint32_t i = 0; i + 1 < branch.points.size(); ++i)
    for (std::uint32_t k = 0; k < std::uint32_t(sides); ++k) {
      const std::uint32_t a = first + i * row + k;
      mesh.indices.insert(mesh.indices.end(), {a, a + 1, a + 1 + row, a, a + 1 + row, a + row});
    }
}

/// A spray of leaves that grows from `foot` along `along`, its upper side turned to the light outside of the
/// crown.
void add_spray(Mesh& mesh, glm::vec3 foot, glm::vec3 along, glm::vec3 outward, float size_m, Random& random) {
  const glm::vec3 tilt(random.uniform(-0.8f, 0.8f), random.uniform(-0.8f, 0.8f), random.uniform(-0.2f, 0.9f));
  const glm::vec3 across = glm::normalize(glm::cross(along, glm::normalize(outward + tilt + 0.01f * along)));
  const glm::vec3 face = glm::cross(across, along);
  const glm::vec3 normal =
      glm::normalize(face + 0.9f * outward);  // crowns shade as a whole, not leaf by leaf
  const auto first = std::uint32_t(mesh.positions.size());
  const glm::vec3 half = 0.5f * size_m * across, tip = size_m * along;
  const std::array<glm::vec3, 4> corners{foot - half, foot + half, foot + half + tip, foot - half + tip};
  constexpr std::array<glm::vec2, 4> uvs{{{0, 1}, {1, 1}, {1, 0}, {0, 0}}};
  for (std::size_t i = 0; i < 4; ++i) {
    mesh.positions.push_back(corners[i]), mesh.normals.push_back(normal), mesh.uvs.push_back(uvs[i]);
  }
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

/// `count` sprays, spread over the thin branches by their length.
Mesh foliage(const std::vector<Branch>& tree, std::size_t count, glm::vec3 crown_middle, Random& random) {
  std::vector<const Branch*> twigs;
  for (const Branch& branch : tree)
    if (branch.order >= leaf_bearing_order) twigs.push_back(&branch);
  Mesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const Branch& twig = *twigs[i % twigs.size()];
    const float place = std::sqrt(random.uniform(0.04f, 1.0f)) * float(twig.points.size() - 1);
    const std::size_t k = std::min(std::size_t(place), twig.points.size() - 2);
    const glm::vec3 foot = glm::mix(twig.points[k], twig.points[k + 1], place - float(k));
    const glm::vec3 axis = glm::normalize(twig.points[k + 1] - twig.points[k]);
    const glm::vec3 outward = glm::normalize(foot - crown_middle + glm::vec3(0, 0, 0.6f));
    const glm::vec3 stray(random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f),
                          random.uniform(-0.8f, 0.6f));
    add_spray(mesh, foot, glm::normalize(0.55f * axis + 0.85f * stray + 0.3f * outward), outward,
              random.uniform(0.26f, 0.42f), random);
  }
  return mesh;
}

scene::Texture texture(std::string name, Image8 image, bool is_srgb, bool repeats) {
  scene::Texture result;
  result.name = std::move(name), result.image = std::move(image), result.is_srgb = is_srgb,
  result.repeats = repeats;
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

void add_materials(scene::Model& model, int species, Random& random) {
  const glm::vec3 green =
      species == 0 ? linear_from_srgb8(0x86, 0xA4, 0x4C) : linear_from_srgb8(0x76, 0x98, 0x46);
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
  Mesh green = foliage(tree, (tree_triangles - wood.triangle_count()) / 2, crown_middle, random);

  scene::Model model;
  model.name = species_index == 0 ? "street_tree" : "park_tree";
  add_materials(model, species_index, random);
  add_part(model, "wood", std::move(wood), bark);
  add_part(model, "foliage", std::move(green), leaves);
  return model;
}

}  // namespace parvis::city
