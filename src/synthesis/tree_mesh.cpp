#include "synthesis/tree_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "synthesis/leaf_texture.h"

namespace parvis::synthesis {
namespace {

/// Unit vectors across a branch at point i.
std::array<glm::vec3, 2> cross_section(const Branch& branch, std::size_t i) {
  const std::size_t last = branch.points.size() - 1;
  const glm::vec3 axis =
      glm::normalize(branch.points[std::min(i + 1, last)] - branch.points[i > 0 ? i - 1 : 0]);
  const glm::vec3 side = glm::normalize(glm::cross(axis, glm::vec3(0.31f, 0.87f, 0.12f)));
  return {side, glm::cross(axis, side)};
}

/// A vector between two corners of a box, drawn component by component from z to x: as arguments of one call
/// the draws would have no order.
glm::vec3 draw_between(glm::vec3 low, glm::vec3 high, Random& random) {
  glm::vec3 drawn;
  for (int axis = 2; axis >= 0; --axis) drawn[axis] = random.uniform(low[axis], high[axis]);
  return drawn;
}

/// A spray of leaves that grows from `foot` along `along`, its upper side turned to the light outside of the
/// crown.
void add_spray(Mesh& mesh, glm::vec3 foot, glm::vec3 along, glm::vec3 outward, float size_m, Random& random) {
  const glm::vec3 tilt = draw_between({-0.8f, -0.8f, -0.2f}, {0.8f, 0.8f, 0.9f}, random);
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

}  // namespace

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

Mesh foliage(const std::vector<Branch>& tree, const Sprays& sprays, glm::vec3 crown_middle, Random& random) {
  std::vector<const Branch*> twigs;
  for (const Branch& branch : tree)
    if (branch.order >= leaf_bearing_order) twigs.push_back(&branch);
  Mesh mesh;
  for (std::size_t i = 0; i < sprays.count; ++i) {
    const Branch& twig = *twigs[i % twigs.size()];
    const float place = std::sqrt(random.uniform(0.04f, 1.0f)) * float(twig.points.size() - 1);
    const std::size_t k = std::min(std::size_t(place), twig.points.size() - 2);
    const glm::vec3 foot = glm::mix(twig.points[k], twig.points[k + 1], place - float(k));
    const glm::vec3 axis = glm::normalize(twig.points[k + 1] - twig.points[k]);
    const glm::vec3 outward = glm::normalize(foot - crown_middle + glm::vec3(0, 0, 0.6f));
    const glm::vec3 stray = draw_between({-1.0f, -1.0f, -0.8f}, {1.0f, 1.0f, 0.6f}, random);
    add_spray(mesh, foot, glm::normalize(0.55f * axis + 0.85f * stray + 0.3f * outward), outward,
              sprays.size_m * random.uniform(0.765f, 1.235f), random);
  }
  return mesh;
}

}  // namespace parvis::synthesis
