#include "planning/share/plant_model.h"

#include <algorithm>
#include <cmath>

#include "life/vegetation/bark.h"

namespace parvis::share {
namespace {

/// A tree of its own in a browser; leaves stand in an order of which every prefix is a good sample.
constexpr std::size_t max_shown_leaves = 12'000, max_wood_triangles = 12'000;
constexpr float bark_repeats = 2.0f, bark_roughness = 0.9f;

Mesh shown_leaves(const vegetation::PlantShape& shape) {
  const vegetation::PlantKind& kind = shape.kind();
  const vegetation::LeafTemplate& form = vegetation::simple_leaf(kind.leaf);
  const std::size_t count = std::min(shape.leaves.size(), max_shown_leaves);
  const float growth = std::sqrt(float(shape.leaves.size()) / float(std::max<std::size_t>(count, 1)));
  Mesh mesh;
  for (std::size_t i = 0; i < count; ++i) {
    const vegetation::Leaf& leaf = shape.leaves[i];
    const auto first = std::uint32_t(mesh.positions.size());
    const glm::mat3 plant_from_leaf(glm::cross(leaf.along, leaf.normal), leaf.along, leaf.normal);
    for (std::size_t corner = 0; corner < form.points.size(); ++corner) {
      mesh.positions.push_back(leaf.foot + growth * leaf.length_m * (plant_from_leaf * form.points[corner]));
      mesh.normals.push_back(plant_from_leaf * form.normals[corner]);
      mesh.uvs.emplace_back(form.points[corner]);
      mesh.colours.emplace_back(glm::mix(kind.dark, kind.light, leaf.tint), leaf.openness);
    }
    for (const std::uint16_t corner : form.indices) mesh.indices.push_back(first + corner);
  }
  return mesh;
}

Mesh shown_wood(const vegetation::PlantShape& shape) {
  Mesh mesh = shape.wood;
  std::size_t end = 0;  // the thickest pieces come first
  for (const vegetation::WoodPiece& piece : shape.pieces)
    if (piece.end <= 3 * max_wood_triangles) end = piece.end;
  mesh.indices.resize(std::min(mesh.indices.size(), std::max<std::size_t>(end, 3)));
  for (const float openness : shape.wood_openness) mesh.colours.emplace_back(1.0f, 1.0f, 1.0f, openness);
  return mesh;
}

}  // namespace

bool is_thinned(const vegetation::PlantShape& shape) { return shape.leaves.size() > max_shown_leaves; }

scene::Model plant_model(const vegetation::PlantShape& shape) {
  const vegetation::PlantKind& kind = shape.kind();
  scene::Model model;
  model.name = std::string(kind.name);
  model.textures.push_back(vegetation::bark_texture());
  scene::Material leaf, bark;
  leaf.name = "leaves", leaf.base_colour = glm::vec3(1.0f), leaf.roughness = kind.roughness;
  leaf.translucency = kind.translucency, leaf.is_double_sided = true;
  model.materials.push_back(leaf);
  bark.name = "bark", bark.base_colour = glm::min(2.0f * kind.bark, glm::vec3(1.0f));
  bark.roughness = bark_roughness, bark.base_colour_texture = 0;
  bark.texture_from_mesh_uv[0][0] = bark.texture_from_mesh_uv[1][1] = bark_repeats;
  model.materials.push_back(bark);
  scene::Part leaves, wood;
  leaves.object = "leaves", leaves.mesh = shown_leaves(shape);
  wood.object = "wood", wood.mesh = shown_wood(shape), wood.material = 1;
  for (scene::Part* part : {&leaves, &wood})
    if (part->mesh.triangle_count() > 0) model.parts.push_back(std::move(*part));
  return model;
}

}  // namespace parvis::share
