// The ray through a point of a picture.
#pragma once

#include "base/camera.h"
#include "graphics/reference/ray_scene.h"

namespace parvis::reference {

/// The rays of one picture; equal to camera_ray's.
class CameraRays {
 public:
  CameraRays(const Camera& camera, int width, int height);
  /// The ray through `pixel`, counted in pixels from the picture's top left; it begins at the near plane.
  Ray through(glm::vec2 pixel) const;

 private:
  glm::mat3 world_from_camera_;
  glm::vec3 eye_;
  FrustumTangents edges_;
  glm::vec2 size_;
  float near_m_;
  float parallel_m_;  ///< distance of a parallel view; 0: the camera is none
};

/// The ray through `pixel`, counted in pixels from the picture's top left; it begins at the near plane, as
/// the renderer's picture does.
Ray camera_ray(const Camera& camera, int width, int height, glm::vec2 pixel);

}  // namespace parvis::reference
