#include "graphics/reference/camera_ray.h"

#include <cmath>

namespace parvis::reference {

Ray camera_ray(const Camera& camera, int width, int height, glm::vec2 pixel) {
  const float tangent = std::tan(0.5f * camera.vertical_fov), aspect = float(width) / float(height);
  const glm::vec3 in_camera((2.0f * pixel.x / float(width) - 1.0f) * tangent * aspect,
                            (1.0f - 2.0f * pixel.y / float(height)) * tangent, -1.0f);
  const float slant = glm::length(in_camera);
  return {camera.position_in_world(), glm::mat3(camera.world_from_camera) * in_camera / slant,
          camera.near_m * slant};
}

}  // namespace parvis::reference
