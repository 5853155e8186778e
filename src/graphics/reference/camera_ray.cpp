#include "graphics/reference/camera_ray.h"

namespace parvis::reference {

CameraRays::CameraRays(const Camera& camera, int width, int height)
    : world_from_camera_(camera.world_from_camera),
      eye_(camera.position_in_world()),
      edges_(camera.tangents(float(width) / float(height))),
      size_(float(width), float(height)),
      near_m_(camera.near_m),
      parallel_m_(camera.parallel ? camera.parallel->distance_m : 0.0f) {}

Ray CameraRays::through(glm::vec2 pixel) const {
  const float across = 2.0f * pixel.x / size_.x - 1.0f, up = 1.0f - 2.0f * pixel.y / size_.y;
  const glm::vec3 in_camera(0.5f * (edges_.right + edges_.left + across * (edges_.right - edges_.left)),
                            0.5f * (edges_.top + edges_.bottom + up * (edges_.top - edges_.bottom)), -1.0f);
  if (parallel_m_ > 0.0f)
    return {eye_ + world_from_camera_ * (parallel_m_ * glm::vec3(glm::vec2(in_camera), 0.0f)),
            world_from_camera_ * glm::vec3(0.0f, 0.0f, -1.0f), near_m_};
  const float slant = glm::length(in_camera);
  return {eye_, world_from_camera_ * in_camera / slant, near_m_ * slant};
}

Ray camera_ray(const Camera& camera, int width, int height, glm::vec2 pixel) {
  return CameraRays(camera, width, height).through(pixel);
}

}  // namespace parvis::reference
