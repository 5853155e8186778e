// Which of many pieces of road come near one another in plan.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

namespace parvis::scene {

/// A box in plan, in metres.
struct PlanBox {
  glm::vec2 min, max;
};

/// Boxes in a tree (Boost's R-tree, packed): however they lie, a question takes the logarithm of their
/// number.
class SegmentFinder {
 public:
  explicit SegmentFinder(const std::vector<PlanBox>& boxes);
  ~SegmentFinder();
  SegmentFinder(const SegmentFinder&) = delete;
  SegmentFinder& operator=(const SegmentFinder&) = delete;

  /// The numbers of the boxes that touch this one and are above `after`, ascending, in `found`.
  void find(const PlanBox& box, std::size_t after, std::vector<std::size_t>& found) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace parvis::scene
