#include "capture/trees/sample_trees.h"

#include <algorithm>
#include <cmath>

#include "base/colour.h"
#include "synthesis/tree.h"
#include "synthesis/tree_mesh.h"
#include "synthesis/tree_skeleton.h"

namespace parvis::trees {
namespace {

constexpr int bark_material = 0, leaf_material = 1;  // materials of Parvis's trees

struct Kind {
  synthesis::Species species;
  synthesis::Sprays sprays;
  glm::vec3 leaf_tint, bark_tint;
  int fruits = 0;
};

/// Orders: children, first, length share, angle, upward, wander, steps, sides.
Kind kind_of(std::string_view name) {
  if (name == "orange")
    return {{3.6f,
             0.09f,
             {{0, 0.0f, 1.0f, 0.0f, 0.01f, 0.05f, 10, 10},
              {16, 0.34f, 0.50f, 62.0f, 0.10f, 0.12f, 6, 7},
              {8, 0.2f, 0.46f, 52.0f, 0.02f, 0.18f, 4, 5},
              {4, 0.2f, 0.5f, 46.0f, -0.02f, 0.2f, 3, 3}}},
            {2600, 0.24f},
            {0.62f, 0.80f, 0.42f},
            {0.9f, 0.85f, 0.8f},
            90};
  if (name == "oak")
    return {{12.0f,
             0.30f,
             {{0, 0.0f, 1.0f, 0.0f, 0.01f, 0.07f, 12, 12},
              {14, 0.26f, 0.58f, 66.0f, 0.10f, 0.14f, 8, 8},
              {9, 0.22f, 0.44f, 52.0f, 0.02f, 0.18f, 5, 5},
              {6, 0.2f, 0.5f, 48.0f, -0.03f, 0.2f, 3, 3}}},
            {7000, 0.55f},
            {0.95f, 1.0f, 0.8f},
            {0.8f, 0.75f, 0.7f}};
  if (name == "pine")
    return {{11.0f,
             0.17f,
             {{0, 0.0f, 1.0f, 0.0f, 0.0f, 0.02f, 14, 10},
              {44, 0.2f, 0.34f, 82.0f, 0.03f, 0.06f, 6, 5},
              {9, 0.15f, 0.32f, 50.0f, -0.02f, 0.1f, 3, 4},
              {3, 0.2f, 0.45f, 40.0f, -0.02f, 0.1f, 2, 3}}},
            {8000, 0.34f},
            {0.42f, 0.62f, 0.50f},
            {1.0f, 0.72f, 0.55f}};
  return {{9.5f,
           0.16f,
           {{0, 0.0f, 1.0f, 0.0f, 0.02f, 0.045f, 12, 10},
            {17, 0.30f, 0.46f, 56.0f, 0.09f, 0.10f, 8, 7},
            {9, 0.25f, 0.46f, 50.0f, 0.03f, 0.16f, 5, 5},
            {6, 0.2f, 0.52f, 46.0f, -0.02f, 0.2f, 4, 4}}},
          {0, 0.0f},
          {1.0f, 1.0f, 1.0f},
          {0.85f, 0.8f, 0.78f}};
}

/// A ball of 12 x 8 quads.
void add_ball(Mesh& mesh, glm::vec3 middle, float radius_m) {
  constexpr int around = 12, rows = 8;
  const auto first = std::uint32_t(mesh.positions.size());
  for (int r = 0; r <= rows; ++r)
    for (int a = 0; a <= around; ++a) {
      const float polar = 3.14159265f * float(r) / rows, turn = 6.2831853f * float(a) / around;
      const glm::vec3 out(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                          std::cos(polar));
      mesh.positions.push_back(middle + radius_m * out), mesh.normals.push_back(out);
      mesh.uvs.emplace_back(float(a) / around, float(r) / rows);
    }
  constexpr auto row = std::uint32_t(around + 1);
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t a = 0; a < around; ++a) {
      const std::uint32_t i = first + r * row + a;
      mesh.indices.insert(mesh.indices.end(), {i, i + row, i + row + 1, i, i + row + 1, i + 1});
    }
}

/// Hanging below twigs of the crown's outside.
Mesh fruit(const std::vector<synthesis::Branch>& tree, int count, Random& random) {
  Mesh mesh;
  std::vector<const synthesis::Branch*> twigs;
  for (const synthesis::Branch& branch : tree)
    if (branch.order == 2) twigs.push_back(&branch);
  for (int i = 0; i < count; ++i)
    add_ball(mesh,
             twigs[std::size_t(random.index(int(twigs.size())))]->points.back() - glm::vec3(0, 0, 0.05f),
             random.uniform(0.035f, 0.045f));
  return mesh;
}

void add_part(scene::Model& model, const char* name, Mesh mesh, int material) {
  if (mesh.indices.empty()) return;
  scene::Part part;
  part.object = name, part.mesh = std::move(mesh), part.material = material;
  model.parts.push_back(std::move(part));
}

}  // namespace

Result<scene::Model> make_sample_tree(std::string_view name, std::uint64_t seed) {
  if (std::ranges::find(sample_tree_names, name) == sample_tree_names.end())
    return error("no sample tree is called \"{}\"; there are {}", name, fmt::join(sample_tree_names, ", "));
  const Kind kind = kind_of(name);
  Random random(seed, 300);
  const std::vector<synthesis::Branch> tree = synthesis::grow_tree(kind.species, random);
  Mesh wood;
  for (const synthesis::Branch& branch : tree)
    synthesis::add_tube(wood, branch, kind.species.orders[std::size_t(branch.order)].sides);

  scene::Model model = synthesis::make_tree(1, seed);  // for its bark and leaves
  model.name = std::string(name), model.parts.clear();
  model.materials[bark_material].base_colour *= kind.bark_tint,
      model.materials[leaf_material].base_colour *= kind.leaf_tint;
  add_part(model, "wood", std::move(wood), bark_material);
  if (kind.sprays.count > 0)
    add_part(model, "foliage",
             synthesis::foliage(tree, kind.sprays, {0.0f, 0.0f, 0.55f * kind.species.height_m}, random),
             leaf_material);
  if (kind.fruits > 0) {
    scene::Material orange;
    orange.name = "fruit", orange.base_colour = linear_from_srgb8(0xF0, 0x80, 0x10), orange.roughness = 0.5f;
    model.materials.push_back(orange);
    add_part(model, "fruit", fruit(tree, kind.fruits, random), int(model.materials.size()) - 1);
  }
  return model;
}

}  // namespace parvis::trees
