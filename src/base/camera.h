// The pinhole camera. In its own frame it looks along -z, y is up, x is right (as OpenGL and glTF have it).
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace parvis {

struct Camera {
  glm::mat4 world_from_camera{1.0f};  ///< rigid
  float vertical_fov = 0.8f;          ///< radians
  float near_m = 0.1f;
  float far_m = 4000.0f;

  glm::vec3 position_in_world() const { return glm::vec3(world_from_camera[3]); }
  glm::vec3 forward_in_world() const { return -glm::vec3(world_from_camera[2]); }
  glm::mat4 camera_from_world() const { return glm::inverse(world_from_camera); }
  glm::mat4 clip_from_camera(float aspect) const {
    return glm::perspective(vertical_fov, aspect, near_m, far_m);
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
