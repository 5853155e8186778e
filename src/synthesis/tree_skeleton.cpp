#include "synthesis/tree_skeleton.h"

#include <algorithm>
#include <cmath>

namespace parvis::synthesis {
namespace {

constexpr float golden_angle = 2.39996323f;

glm::vec3 random_direction(Random& random) {
  const float z = random.uniform(-1.0f, 1.0f), turn = random.uniform(0.0f, 6.2831853f);
  const float r = std::sqrt(1.0f - z * z);
  return {r * std::cos(turn), r * std::sin(turn), z};
}

/// A unit vector at `angle` from `axis`, turned round it by `turn`.
glm::vec3 leaning_from(glm::vec3 axis, float angle, float turn) {
  const glm::vec3 side =
      glm::normalize(glm::cross(axis, std::abs(axis.z) < 0.9f ? glm::vec3(0, 0, 1) : glm::vec3(1, 0, 0)));
  const glm::vec3 other = glm::cross(axis, side);
  return std::cos(angle) * axis + std::sin(angle) * (std::cos(turn) * side + std::sin(turn) * other);
}

Branch grow_branch(glm::vec3 start, glm::vec3 direction, float length_m, float radius_m, int order,
                   const BranchOrder& rule, Random& random) {
  Branch branch;
  branch.order = order;
  glm::vec3 point = start;
  const float step_m = length_m / float(rule.steps);
  for (int i = 0; i <= rule.steps; ++i) {
    const float along = float(i) / float(rule.steps);
    branch.points.push_back(point), branch.radii_m.push_back(radius_m * (1.0f - 0.78f * along));
    direction =
        glm::normalize(direction + rule.wander * random_direction(random) + rule.upward * glm::vec3(0, 0, 1));
    point += step_m * direction;
  }
  return branch;
}

float length_of(const Branch& branch) {
  float sum = 0.0f;
  for (std::size_t i = 1; i < branch.points.size(); ++i)
    sum += glm::length(branch.points[i] - branch.points[i - 1]);
  return sum;
}

/// Limbs are longest low in the crown and short at its top: a rounded outline.
float crown_outline(float along) { return std::sqrt(std::max(1.0f - along * along, 0.02f)); }

void grow_children(std::vector<Branch>& tree, std::size_t parent_index, const Species& species,
                   Random& random) {
  const Branch parent = tree[parent_index];
  const int order = parent.order + 1;
  if (order >= int(species.orders.size())) return;
  const BranchOrder& rule = species.orders[std::size_t(order)];
  const float parent_m = length_of(parent), first_turn = random.uniform(0.0f, 6.2831853f);
  for (int i = 0; i < rule.children; ++i) {
    const float share = (float(i) + random.uniform(0.1f, 0.9f)) / float(rule.children);
    const float along = rule.first + (1.0f - rule.first) * share;
    const float place = along * float(parent.points.size() - 1);
    const std::size_t k = std::min(std::size_t(place), parent.points.size() - 2);
    const glm::vec3 start = glm::mix(parent.points[k], parent.points[k + 1], place - float(k));
    const glm::vec3 axis = glm::normalize(parent.points[k + 1] - parent.points[k]);
    const float angle = glm::radians(rule.angle_deg) * random.uniform(0.75f, 1.2f) * (1.15f - 0.45f * along);
    const float outline = order == 1 ? crown_outline(share) : 1.15f - 0.7f * along;
    const float length_m = parent_m * rule.length_share * outline * random.uniform(0.75f, 1.2f);
    const float radius_m = 0.62f * glm::mix(parent.radii_m[k], parent.radii_m[k + 1], place - float(k));
    tree.push_back(grow_branch(start, leaning_from(axis, angle, first_turn + golden_angle * float(i)),
                               length_m, radius_m, order, rule, random));
  }
}

}  // namespace

std::vector<Branch> grow_tree(const Species& species, Random& random) {
  std::vector<Branch> tree{grow_branch({0, 0, 0}, {0, 0, 1}, species.height_m * 0.86f, species.trunk_radius_m,
                                       0, species.orders[0], random)};
  for (std::size_t i = 0; i < tree.size(); ++i) grow_children(tree, i, species, random);
  return tree;
}

}  // namespace parvis::synthesis
