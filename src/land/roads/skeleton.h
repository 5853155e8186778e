// Medial axis of a plan mask as a graph: branches between junctions and ends.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "land/heights/ground_raster.h"

namespace parvis::scene {

/// A junction or an end of the medial axis; metres, in plan.
struct SkeletonNode {
  glm::vec2 position{0.0f};
  float radius_m = 0.0f;  ///< to the mask's edge
};

/// A branch of the medial axis between two nodes.
struct SkeletonBranch {
  int start = 0, end = 0;         ///< nodes; the same where the branch is a ring
  std::vector<glm::vec2> points;  ///< from node to node, both included
  std::vector<float> radii_m;     ///< at each point, to the mask's edge

  float length_m() const;  ///< along the points
};

/// The medial axis of a mask.
struct Skeleton {
  std::vector<SkeletonNode> nodes;
  std::vector<SkeletonBranch> branches;
};

/// Thins the mask (Zhang and Suen 1984), traces the remaining pixels, removes spurs (branches into corners of
/// the outline) and merges junctions that lie within one another's radius.
Skeleton skeleton_of(const Mask& mask);

}  // namespace parvis::scene
