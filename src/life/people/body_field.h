// A body as distance fields of its trunk and limbs, in the bind pose: what skin and clothes are made of.
#pragma once

#include "life/people/skeleton.h"
#include "life/people/surface_net.h"

namespace parvis::people {

/// A station of the trunk: half breadth, half depths in front and behind, at a height.
struct TrunkStation {
  float z, half, front, back;
};

/// The body of a shape. Offsets, metres, are those of cloth over skin.
class BodyField {
 public:
  explicit BodyField(const BodyShape& shape);

  const BodyShape& shape() const { return shape_; }       ///< lengths, metres
  const Skeleton& skeleton() const { return skeleton_; }  ///< joints in the bind pose

  /// Distance to the trunk from crotch to neck, with breasts and shoulders.
  float trunk(glm::vec3 p, float offset_m) const;
  /// Distance to an arm from shoulder to wrist; 1 is left, -1 right.
  float arm(glm::vec3 p, float side, float offset_m) const;
  /// Distance to a leg from hip to ankle.
  float leg(glm::vec3 p, float side, float offset_m) const;
  /// Place along the arm from the shoulder, metres: less than 0 towards the neck.
  float along_arm(glm::vec3 p, float side) const;
  /// Station of the trunk at a height.
  TrunkStation station(float z) const;

 private:
  BodyShape shape_;
  Skeleton skeleton_;
  std::vector<TrunkStation> stations_;
};

/// Which bones move a vertex of a part.
enum class Moves : std::uint8_t { top, bottom, skirt, head_and_neck, hand_left, hand_right, shoes };

/// Bones and weights of each vertex.
struct BoundVertex {
  glm::uvec4 bones{0};
  glm::vec4 weights{1, 0, 0, 0};
};
/// Linear blend weights of a vertex in the bind pose.
BoundVertex bound(const BodyField& body, glm::vec3 p, Moves moves);

}  // namespace parvis::people
