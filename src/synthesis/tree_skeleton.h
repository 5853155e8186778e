// Skeleton of a broad-leaved tree: a trunk that forks into limbs, branches and twigs, each curved by light
// and weight.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/random.h"

namespace parvis::synthesis {

/// Branching of one order: trunk, limbs, branches or twigs.
struct BranchOrder {
  int children = 0;           ///< per branch of the previous order
  float first = 0.3f;         ///< position of the first child along it, 0..1
  float length_share = 0.5f;  ///< of the parent's length, for a child at its middle
  float angle_deg = 50.0f;    ///< between parent and child
  float upward = 0.0f;        ///< curvature toward the light (negative: downward), per step
  float wander = 0.1f;        ///< random turns, per step
  int steps = 5, sides = 5;   ///< of the tube
};

/// Parameters of a kind of tree.
struct Species {
  float height_m = 11.0f;
  float trunk_radius_m = 0.19f;
  std::vector<BranchOrder> orders;
};

/// A branch as a polyline with radii; metres.
struct Branch {
  std::vector<glm::vec3> points;
  std::vector<float> radii_m;  ///< one per point
  int order = 0;
};

/// Grows a tree: the trunk first, children after their parents. The foot is at the origin.
std::vector<Branch> grow_tree(const Species& species, Random& random);

}  // namespace parvis::synthesis
