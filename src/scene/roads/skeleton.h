// The middle lines of a plan mask as a graph: branches between junctions and ends.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "formats/terrain/ground_raster.h"

namespace parvis::scene {

struct SkeletonNode {
  glm::vec2 position{0.0f};
  float radius_m = 0.0f;  ///< to the mask's edge
};

struct SkeletonBranch {
  int start = 0, end = 0;         ///< nodes; the same where the branch is a ring
  std::vector<glm::vec2> points;  ///< from node to node, both included
  std::vector<float> radii_m;     ///< at each point, to the mask's edge

  float length_m() const;
};

struct Skeleton {
  std::vector<SkeletonNode> nodes;
  std::vector<SkeletonBranch> branches;
};

/// Thins the mask (Zhang and Suen 1984), traces what is left, takes away spurs (branches into mere corners of
/// the outline) and makes one junction of those that lie within one another's width.
Skeleton skeleton_of(const Mask& mask);

}  // namespace parvis::scene
