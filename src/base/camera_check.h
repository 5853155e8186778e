// Whether a camera that was made of what a user gave can be used.
#pragma once

#include "base/camera.h"

namespace parvis {

/// The largest coordinate of a place in a scene, in metres: beyond it floats are coarser than a house.
inline constexpr float max_coordinate_m = 1e9f;

/// Whether rays can be made from the camera: its pose is finite, rigid and within `max_coordinate_m`, its
/// frustum open. To be asked where a camera is made from what a user gave.
inline bool is_usable(const Camera& camera) {
  constexpr float rigid_within = 1e-2f;
  const glm::mat4& pose = camera.world_from_camera;
  for (int axis = 0; axis < 3; ++axis)
    if (!(glm::abs(glm::length(glm::vec3(pose[axis])) - 1.0f) <= rigid_within)) return false;
  for (int i = 0; i < 3; ++i)
    if (!(glm::abs(pose[3][i]) <= max_coordinate_m)) return false;
  const FrustumTangents edges = camera.tangents(1.0f);
  return camera.near_m > 0.0f && camera.far_m > camera.near_m && edges.right > edges.left &&
         edges.top > edges.bottom && edges.top - edges.bottom < 1e6f;
}

}  // namespace parvis
