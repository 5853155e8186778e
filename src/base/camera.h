// The pinhole camera. In its own frame it looks along -z, y is up, x is right (as OpenGL and glTF have it).
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

namespace parvis {

/// Where the edges of a picture lie: tangents of their angles from the camera's axis, negative left of it and
/// below it.
struct FrustumTangents {
  float left, right, bottom, top;

  bool operator==(const FrustumTangents&) const = default;
};

struct Camera {
  glm::mat4 world_from_camera{1.0f};  ///< rigid
  float vertical_fov = 0.8f;          ///< radians, of a frustum that is symmetric about the axis
  /// The frustum of a display wall seen from where the eye is: it holds in place of `vertical_fov`, and of
  /// the aspect ratio of the picture.
  std::optional<FrustumTangents> off_axis = std::nullopt;
  float near_m = 0.1f;
  float far_m = 4000.0f;

  glm::vec3 position_in_world() const { return glm::vec3(world_from_camera[3]); }
  glm::vec3 forward_in_world() const { return -glm::vec3(world_from_camera[2]); }
  glm::mat4 camera_from_world() const { return glm::inverse(world_from_camera); }
  FrustumTangents tangents(float aspect) const {
    if (off_axis) return *off_axis;
    const float top = glm::tan(0.5f * vertical_fov);
    return {-(top * aspect), top * aspect, -top, top};
  }
  /// Of the picture, on a plane at 1 m.
  float height_at_1m() const {
    return off_axis ? off_axis->top - off_axis->bottom : 2.0f * glm::tan(0.5f * vertical_fov);
  }
  glm::mat4 clip_from_camera(float aspect) const {
    if (!off_axis) return glm::perspective(vertical_fov, aspect, near_m, far_m);
    return glm::frustum(near_m * off_axis->left, near_m * off_axis->right, near_m * off_axis->bottom,
                        near_m * off_axis->top, near_m, far_m);
  }
};

/// A camera at `eye` looking at `target`, z up in the world.
inline glm::mat4 look_at(glm::vec3 eye, glm::vec3 target, glm::vec3 up = {0.0f, 0.0f, 1.0f}) {
  return glm::inverse(glm::lookAt(eye, target, up));
}

/// Vertical field of view (radians) of a horizontal one, at width / height.
inline float vertical_fov(float horizontal_fov, float aspect) {
  return 2.0f * glm::atan(glm::tan(0.5f * horizontal_fov) / aspect);
}

}  // namespace parvis
