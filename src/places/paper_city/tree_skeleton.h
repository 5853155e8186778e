// The wood of a broad-leaved tree: a trunk that forks into limbs, branches and twigs, each bent by light and
// weight.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/random.h"

namespace parvis::city {

/// Branching of one order: trunk, limbs, branches, twigs.
struct BranchOrder {
  int children = 0;           ///< along a branch of the order before
  float first = 0.3f;         ///< where along it the first child sits, 0..1
  float length_share = 0.5f;  ///< of the parent's length, at its middle
  float angle_deg = 50.0f;    ///< between parent and child
  float upward = 0.0f;        ///< bends toward the light, or down where negative, per step
  float wander = 0.1f;        ///< random turns, per step
  int steps = 5, sides = 5;   ///< of the tube
};

struct Species {
  float height_m = 11.0f;
  float trunk_radius_m = 0.19f;
  std::vector<BranchOrder> orders;
};

struct Branch {
  std::vector<glm::vec3> points;
  std::vector<float> radii_m;  ///< one a point
  int order = 0;
};

/// Trunk first; children follow their parents. The foot is at the origin.
std::vector<Branch> grow_tree(const Species& species, Random& random);

}  // namespace parvis::city
