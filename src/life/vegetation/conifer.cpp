#include "life/vegetation/conifer.h"

#include <algorithm>
#include <cmath>

namespace parvis::vegetation {
namespace {

using glm::vec3;
using synthesis::Branch, synthesis::BranchOrder;

constexpr float golden_angle = 2.39996323f;
constexpr float whorl_m = 0.42f;        // a year's growth
constexpr float top_angle_deg = 42.0f;  // of the youngest branches, from the trunk
constexpr float twig_step_m = 0.08f;    // between the twigs of a branch
constexpr float lowest_m = 0.12f;       // of what droops, above the ground

/// Lengths of branches over that of the lowest: the outline is a cone that bulges a little.
float outline(float share) { return std::pow(1.0f - share, 0.82f); }

float length_of(const Branch& branch) {
  float sum = 0.0f;
  for (std::size_t i = 1; i < branch.points.size(); ++i)
    sum += glm::distance(branch.points[i], branch.points[i - 1]);
  return sum;
}

struct Place {
  vec3 point, axis;
  float radius_m;
};

/// The place at a fraction of the branch's points.
Place place_on(const Branch& branch, float share) {
  const float at = share * float(branch.points.size() - 1);
  const std::size_t k = std::min(std::size_t(at), branch.points.size() - 2);
  const float between = at - float(k);
  return {glm::mix(branch.points[k], branch.points[k + 1], between),
          glm::normalize(branch.points[k + 1] - branch.points[k]),
          glm::mix(branch.radii_m[k], branch.radii_m[k + 1], between)};
}

Branch grow_branch(const Place& foot, vec3 direction, float length_m, int order, const BranchOrder& rule,
                   Random& random) {
  Branch branch;
  branch.order = order;
  vec3 point = foot.point;
  const float step_m = length_m / float(rule.steps);
  for (int i = 0; i <= rule.steps; ++i) {
    branch.points.push_back({point.x, point.y, std::max(point.z, lowest_m)});
    branch.radii_m.push_back(foot.radius_m * (1.0f - 0.8f * float(i) / float(rule.steps)));
    const vec3 stray(random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f));
    // Weight bends a branch down at first; its tip grows towards the light.
    const float bend = rule.upward * (2.0f * float(i) / float(rule.steps) - 0.6f);
    direction = glm::normalize(direction + rule.wander * stray + vec3(0.0f, 0.0f, bend));
    point += step_m * direction;
  }
  return branch;
}

Branch grow_trunk(const synthesis::Species& species, Random& random) {
  const BranchOrder& rule = species.orders[0];
  Branch trunk;
  for (int i = 0; i <= rule.steps; ++i) {
    const float share = float(i) / float(rule.steps);
    const glm::vec2 stray = rule.wander * std::min(share, 1.0f - share) *
                            glm::vec2(random.uniform(-1.0f, 1.0f), random.uniform(-1.0f, 1.0f));
    trunk.points.emplace_back(stray * species.trunk_radius_m, share * species.height_m);
    trunk.radii_m.push_back(species.trunk_radius_m * (1.0f - 0.97f * share));
  }
  return trunk;
}

void grow_whorls(std::vector<Branch>& tree, const synthesis::Species& species, Random& random) {
  const BranchOrder& rule = species.orders[1];
  const float crown_m = (1.0f - rule.first) * species.height_m;
  const int whorls = std::clamp(int(crown_m / whorl_m), 6, 36);
  float turn = random.uniform(0.0f, 6.2831853f);
  for (int whorl = 0; whorl < whorls; ++whorl)
    for (int i = 0; i < rule.children; ++i) {
      turn += golden_angle + random.uniform(-0.25f, 0.25f);
      const float share =
          std::clamp((float(whorl) + random.uniform(-0.2f, 0.5f)) / float(whorls), 0.0f, 0.985f);
      Place foot = place_on(tree[0], rule.first + (1.0f - rule.first) * share);
      const float length_m =
          rule.length_share * species.height_m * outline(share) * random.uniform(0.8f, 1.15f);
      const float angle = glm::radians(glm::mix(rule.angle_deg, top_angle_deg, share * share));
      const vec3 aside(std::cos(turn), std::sin(turn), 0.0f);
      foot.radius_m = std::min(0.5f * foot.radius_m, 0.007f * length_m + 0.003f);
      tree.push_back(grow_branch(foot, std::cos(angle) * foot.axis + std::sin(angle) * aside, length_m, 1,
                                 rule, random));
    }
}

/// Twigs to both sides of a branch, long ones near its foot: they lie in a plane with it and droop a little.
void grow_comb(std::vector<Branch>& tree, std::size_t parent_index, const BranchOrder& rule, Random& random) {
  const Branch parent = tree[parent_index];
  const float parent_m = length_of(parent);
  const int count = std::clamp(int((1.0f - rule.first) * parent_m / twig_step_m), 2, rule.children);
  for (int i = 0; i < count; ++i) {
    const float share =
        rule.first + (1.0f - rule.first) * (float(i) + random.uniform(0.2f, 0.8f)) / float(count);
    Place foot = place_on(parent, std::min(share, 0.98f));
    const vec3 across = glm::cross(foot.axis, vec3(0.0f, 0.0f, 1.0f));
    const vec3 side = glm::dot(across, across) > 1e-4f ? glm::normalize(across) : vec3(1.0f, 0.0f, 0.0f);
    const float angle = glm::radians(rule.angle_deg) * random.uniform(0.8f, 1.15f);
    const vec3 direction = std::cos(angle) * foot.axis +
                           (i % 2 == 0 ? 1.0f : -1.0f) * std::sin(angle) * side -
                           vec3(0.0f, 0.0f, random.uniform(0.0f, 0.3f));
    const float length_m =
        (rule.length_share * (1.0f - share) * parent_m + 0.05f) * random.uniform(0.75f, 1.15f);
    foot.radius_m *= 0.6f;
    tree.push_back(grow_branch(foot, glm::normalize(direction), length_m, parent.order + 1, rule, random));
  }
}

}  // namespace

std::vector<Branch> grow_in_whorls(const synthesis::Species& species, Random& random) {
  std::vector<Branch> tree{grow_trunk(species, random)};
  grow_whorls(tree, species, random);
  for (std::size_t i = 1; i < tree.size(); ++i)
    if (const auto order = std::size_t(tree[i].order) + 1; order < species.orders.size())
      grow_comb(tree, i, species.orders[order], random);
  return tree;
}

}  // namespace parvis::vegetation
