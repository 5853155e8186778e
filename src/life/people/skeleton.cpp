#include "life/people/skeleton.h"

namespace parvis::people {
namespace {

constexpr std::array<const char*, bone_count> bone_names{
    "pelvis",         "spine",        "chest",         "neck",         "head",
    "left upper arm", "left forearm", "left hand",     "left fingers", "right upper arm",
    "right forearm",  "right hand",   "right fingers", "left thigh",   "left shin",
    "left foot",      "left toes",    "right thigh",   "right shin",   "right foot",
    "right toes"};

}  // namespace

Skeleton skeleton_of(const BodyShape& s) {
  Skeleton k;
  const float h = s.stature;
  k.joint[pelvis] = {0.0f, 0.0f, s.hip_z + 0.02f * h};
  k.joint[spine] = {-0.008f * h, 0.0f, s.hip_z + 0.09f * h};
  k.joint[chest] = {-0.012f * h, 0.0f, std::lerp(s.hip_z, s.shoulder_z, 0.62f)};
  k.joint[neck] = {-0.014f * h, 0.0f, s.shoulder_z + 0.012f * h};
  k.joint[head] = {-0.006f * h, 0.0f, s.chin_z + 0.18f * s.head};
  k.ball_x = 0.70f * s.foot - 0.25f * s.foot;
  k.heel_x = -0.27f * s.foot;
  for (const int side : {0, 1}) {
    const float sign = side == 0 ? 1.0f : -1.0f;
    const int arm = side == 0 ? left_upper_arm : right_upper_arm, leg = side == 0 ? left_thigh : right_thigh;
    const glm::vec3 along = Skeleton::arm_direction(sign);
    k.joint[std::size_t(arm)] = {-0.012f * h, sign * s.shoulder_y, s.shoulder_z - 0.034f * h};
    k.joint[std::size_t(arm + 1)] = k.joint[std::size_t(arm)] + s.upper_arm * along;
    k.joint[std::size_t(arm + 2)] = k.joint[std::size_t(arm + 1)] + s.forearm * along;
    k.joint[std::size_t(arm + 3)] = k.joint[std::size_t(arm + 2)] + 0.5f * s.hand * along;
    k.joint[std::size_t(leg)] = {0.0f, sign * s.hip_y, s.hip_z};
    k.joint[std::size_t(leg + 1)] = {0.004f * h, sign * (s.hip_y + 0.026f * h), s.knee_z};
    k.joint[std::size_t(leg + 2)] = {-0.006f * h, sign * (s.hip_y + 0.050f * h), s.ankle_z};
    k.joint[std::size_t(leg + 3)] = {k.ball_x, sign * (s.hip_y + 0.052f * h), 0.016f * h};
  }
  return k;
}

glm::vec3 Skeleton::end(int bone, const BodyShape& shape) const {
  switch (bone) {
    case pelvis:
      return joint[spine];
    case spine:
      return joint[chest];
    case chest:
      return joint[neck];
    case neck:
      return joint[people::head];
    case people::head:
      return joint[people::head] + glm::vec3(0, 0, 0.6f * shape.head);
    case left_fingers:
    case right_fingers:
      return joint[std::size_t(bone)] +
             0.5f * shape.hand * arm_direction(bone == left_fingers ? 1.0f : -1.0f);
    case left_toes:
    case right_toes:
      return joint[std::size_t(bone)] + glm::vec3(0.3f * shape.foot, 0, 0);
    default:
      return joint[std::size_t(bone) + 1];
  }
}

Posture between(const Posture& a, const Posture& b, float part) {
  Posture result;
  result.pelvis_position = glm::mix(a.pelvis_position, b.pelvis_position, part);
  for (std::size_t i = 0; i < bone_count; ++i) result.turn[i] = glm::slerp(a.turn[i], b.turn[i], part);
  return result;
}

std::vector<glm::mat4> pose_of(const Skeleton& skeleton, const Posture& posture) {
  std::vector<glm::mat4> pose(bone_count + 1, glm::mat4(1.0f));
  for (std::size_t b = 0; b < bone_count; ++b) {
    const int parent = parent_bone[b];
    const glm::vec3 offset =
        parent < 0 ? posture.pelvis_position : skeleton.joint[b] - skeleton.joint[std::size_t(parent)];
    glm::mat4 local = glm::mat4_cast(posture.turn[b]);
    local[3] = glm::vec4(offset, 1.0f);
    pose[b + 1] = pose[std::size_t(parent + 1)] * local;
  }
  return pose;
}

std::vector<scene::ModelNode> nodes_of(const Skeleton& skeleton) {
  std::vector<scene::ModelNode> nodes(1);
  nodes[0].name = "person";
  for (std::size_t b = 0; b < bone_count; ++b) {
    scene::ModelNode node;
    node.name = bone_names[b];
    const int parent = parent_bone[b];
    node.parent = parent + 1;
    node.translation =
        glm::dvec3(parent < 0 ? skeleton.joint[b] : skeleton.joint[b] - skeleton.joint[std::size_t(parent)]);
    nodes.push_back(std::move(node));
  }
  return nodes;
}

}  // namespace parvis::people
