// The bones of a person, and where their joints are while the mesh is bound to them: upright, legs straight
// and a little apart, arms away from the trunk. In this pose the axes of all bones are those of the model: x
// forward, y left, z up.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "life/people/body_shape.h"
#include "scene/data/model.h"

namespace parvis::people {

/// Bones, parents before children. Node n + 1 of a model is bone n; node 0 is the model's root.
enum Bone : std::uint8_t {
  pelvis,
  spine,
  chest,
  neck,
  head,
  left_upper_arm,
  left_forearm,
  left_hand,
  left_fingers,
  right_upper_arm,
  right_forearm,
  right_hand,
  right_fingers,
  left_thigh,
  left_shin,
  left_foot,
  left_toes,
  right_thigh,
  right_shin,
  right_foot,
  right_toes,
  bone_count
};

inline constexpr float bind_arm_deg = 38.0f;  ///< between arm and vertical

inline constexpr std::array<int, bone_count> parent_bone{
    -1,           pelvis,    spine,     chest,           neck,          chest,      left_upper_arm,
    left_forearm, left_hand, chest,     right_upper_arm, right_forearm, right_hand, pelvis,
    left_thigh,   left_shin, left_foot, pelvis,          right_thigh,   right_shin, right_foot};

/// Joints in the bind pose.
struct Skeleton {
  std::array<glm::vec3, bone_count> joint;
  float ball_x = 0.0f;  ///< of the ball of the foot before the ankle, on the ground
  float heel_x = 0.0f;  ///< of the heel, negative

  /// Direction of the arm of a side (1: left).
  static glm::vec3 arm_direction(float side) {
    const float a = glm::radians(bind_arm_deg);
    return {0.0f, side * std::sin(a), -std::cos(a)};
  }
  /// The end of a bone: where its child begins, or its tip.
  glm::vec3 end(int bone, const BodyShape& shape) const;
};

/// The skeleton of a body.
Skeleton skeleton_of(const BodyShape& shape);

/// A posture: the place of the pelvis and how each bone is turned against its parent.
struct Posture {
  glm::vec3 pelvis_position{0.0f};
  std::array<glm::quat, bone_count> turn;

  Posture() { turn.fill(glm::quat(1, 0, 0, 0)); }
};

/// A posture between two others, 0..1.
Posture between(const Posture& a, const Posture& b, float part);

/// model_from_node of all nodes of a person's model (the root and the bones).
std::vector<glm::mat4> pose_of(const Skeleton& skeleton, const Posture& posture);

/// The nodes of a model with this skeleton.
std::vector<scene::ModelNode> nodes_of(const Skeleton& skeleton);

}  // namespace parvis::people
