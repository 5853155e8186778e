// The pinhole camera. In its own frame it looks along -z, y is up, x is right (as OpenGL and glTF have it).
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

namespace parvis {

/// Edges of an image as tangents of their angles from the camera's axis; negative to the left of the axis and
/// below it.
struct FrustumTangents {
  float left, right, bottom, top;

  bool operator==(const FrustumTangents&) const = default;
};

/// A parallel projection, as plans have it.
struct ParallelView {
  float height_m = 1.0f;      ///< of the image, in the world
  float distance_m = 100.0f;  ///< of what is looked at, for those who ask for the size of a pixel by distance

  bool operator==(const ParallelView&) const = default;
};

/// A camera: rigid pose in the world, near and far plane in metres, and a symmetric vertical field of view,
/// an off-axis frustum or a parallel projection. The aspect ratio (width / height) belongs to the image and
/// is passed in.
struct Camera {
  glm::mat4 world_from_camera{1.0f};  ///< rigid
  float vertical_fov = 0.8f;          ///< radians, of a frustum that is symmetric about the axis
  /// The off-axis frustum, as a display wall and an eye position define it. Where it is set, `vertical_fov`
  /// and the aspect ratio of the image are ignored.
  std::optional<FrustumTangents> off_axis = std::nullopt;
  /// Where it is set, all rays go along the axis; the fields of view are ignored.
  std::optional<ParallelView> parallel = std::nullopt;
  float near_m = 0.1f;
  float far_m = 4000.0f;

  /// Centre of projection, metres.
  glm::vec3 position_in_world() const { return glm::vec3(world_from_camera[3]); }
  /// Unit viewing direction: the camera's -z axis.
  glm::vec3 forward_in_world() const { return -glm::vec3(world_from_camera[2]); }
  /// View matrix: transforms points of the world into the camera's frame.
  glm::mat4 camera_from_world() const { return glm::inverse(world_from_camera); }
  /// Edges of the image for `aspect` = width / height; the off-axis frustum where there is one. Of a parallel
  /// view: as seen from the eye at its distance.
  FrustumTangents tangents(float aspect) const {
    if (off_axis && !parallel) return *off_axis;
    const float top = 0.5f * height_at_1m();
    return {-(top * aspect), top * aspect, -top, top};
  }
  /// Height of the image on a plane 1 m before the camera, metres.
  float height_at_1m() const {
    if (parallel) return parallel->height_m / parallel->distance_m;
    return off_axis ? off_axis->top - off_axis->bottom : 2.0f * glm::tan(0.5f * vertical_fov);
  }
  /// OpenGL projection matrix (clip z from -1 at the near plane to 1 at the far plane), off-axis where the
  /// camera is.
  glm::mat4 clip_from_camera(float aspect) const {
    if (parallel) {
      const float up = 0.5f * parallel->height_m, right = up * aspect;
      return glm::ortho(-right, right, -up, up, near_m, far_m);
    }
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
