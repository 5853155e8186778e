#include "scene/data/leaf_openness.h"

#include <algorithm>
#include <map>

#include "base/parallel.h"
#include "scene/data/crown_openness.h"

namespace parvis::scene {
namespace {

/// A part may hold all trees of a town: leaves are looked at in squares, with those that stand around.
constexpr float square_m = 16.0f, around_m = 4.0f;

/// Share of a leaf's quad that its picture leaves.
float cover_of(const Material& material, const Model& model) {
  if (material.base_colour_texture == no_index) return 1.0f;
  const Image8& image = model.textures[std::size_t(material.base_colour_texture)].image;
  const std::size_t count = image.pixels.size() / 4;
  std::size_t opaque = 0;
  for (std::size_t i = 0; i < count; ++i) opaque += image.pixels[4 * i + 3] >= 128;
  return count > 0 ? float(opaque) / float(count) : 1.0f;
}

std::vector<LeafArea> leaf_areas(const Mesh& mesh, float cover) {
  std::vector<LeafArea> areas;
  areas.reserve(mesh.triangle_count());
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const glm::vec3 a = mesh.positions[mesh.indices[i]], b = mesh.positions[mesh.indices[i + 1]],
                    c = mesh.positions[mesh.indices[i + 2]];
    areas.push_back({(a + b + c) / 3.0f, 0.5f * cover * glm::length(glm::cross(b - a, c - a))});
  }
  return areas;
}

/// Leaves and vertices of a square of the ground plan.
struct Square {
  std::vector<LeafArea> leaves;  ///< those around it, too
  std::vector<std::uint32_t> vertices;
};

using Squares = std::map<std::pair<int, int>, Square>;

Squares squares_of(const Mesh& mesh, float cover) {
  Squares squares;
  const Bounds bounds = mesh.bounds();
  const glm::vec2 corner(bounds.min), size = glm::vec2(bounds.max) - corner;
  // One tree, though it be wider than a square, is looked at as a whole.
  const float side_m = std::max(size.x, size.y) < 2.0f * square_m ? 2.0f * square_m : square_m;
  const auto square_at = [&](glm::vec2 place) { return glm::ivec2(glm::floor((place - corner) / side_m)); };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::ivec2 at = square_at(glm::vec2(mesh.positions[i]));
    squares[{at.x, at.y}].vertices.push_back(std::uint32_t(i));
  }
  for (const LeafArea& leaf : leaf_areas(mesh, cover)) {
    const glm::ivec2 low = square_at(glm::vec2(leaf.place) - around_m),
                     high = square_at(glm::vec2(leaf.place) + around_m);
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x)
        if (const auto square = squares.find({x, y}); square != squares.end())
          square->second.leaves.push_back(leaf);
  }
  return squares;
}

struct OfVertices {
  std::vector<float> openness, max_seen;
};

OfVertices openness_of(const Mesh& mesh, float cover) {
  OfVertices found{std::vector<float>(mesh.positions.size(), 1.0f),
                   std::vector<float>(mesh.positions.size(), 1.0f)};
  for (const auto& [place, square] : squares_of(mesh, cover)) {
    const CrownOpenness crown(square.leaves);
    parallel_for(
        square.vertices.size(),
        [&](std::size_t i) {
          const std::uint32_t vertex = square.vertices[i];
          found.openness[vertex] = crown.at(mesh.positions[vertex]);
          found.max_seen[vertex] = crown.max_seen(mesh.positions[vertex]);
        },
        256);
  }
  return found;
}

}  // namespace

bool is_foliage(const Material& material) {
  return material.alpha_mode == Alpha::cutout && material.translucency > 0.0f;
}

std::span<const float> LeafOpenness::of(const Model& model, std::size_t part) const {
  const auto found = models.find(&model);
  return found == models.end() ? std::span<const float>() : found->second->parts[part];
}

std::span<const float> LeafOpenness::max_seen(const Model& model, std::size_t part) const {
  const auto found = models.find(&model);
  return found == models.end() ? std::span<const float>() : found->second->max_seen[part];
}

void find_leaf_openness(Scene& scene) {
  LeafOpenness found = scene.data<LeafOpenness>();
  const std::size_t known = found.models.size();
  for (const Object& object : scene.objects) {
    const Model& model = *object.model;
    if (found.models.contains(&model)) continue;
    const auto is_leafy = [&](const Part& part) {
      return is_foliage(model.materials[std::size_t(part.material)]) && !part.deformation;
    };
    if (std::ranges::none_of(model.parts, is_leafy)) continue;
    LeafOpenness::OfModel of_model{object.model, {}, {}};
    of_model.parts.reserve(model.parts.size()), of_model.max_seen.reserve(model.parts.size());
    for (const Part& part : model.parts) {
      OfVertices of_part;
      if (is_leafy(part))
        of_part = openness_of(part.mesh, cover_of(model.materials[std::size_t(part.material)], model));
      of_model.parts.push_back(std::move(of_part.openness));
      of_model.max_seen.push_back(std::move(of_part.max_seen));
    }
    found.models.emplace(&model, std::make_shared<const LeafOpenness::OfModel>(std::move(of_model)));
  }
  if (found.models.size() > known) scene.data<LeafOpenness>() = std::move(found);
}

}  // namespace parvis::scene
