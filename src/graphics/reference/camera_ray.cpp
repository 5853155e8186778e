#include "graphics/reference/camera_ray.h"

namespace parvis::reference {

Ray camera_ray(const Camera& camera, int width, int height, glm::vec2 pixel) {
  const FrustumTangents edges = camera.tangents(float(width) / float(height));
  const float across = 2.0f * pixel.x / float(width) - 1.0f, up = 1.0f - 2.0f * pixel.y / float(height);
  const glm::vec3 in_camera(0.5f * (edges.right + edges.left + across * (edges.right - edges.left)),
                            0.5f * (edges.top + edges.bottom + up * (edges.top - edges.bottom)), -1.0f);
  const float slant = glm::length(in_camera);
  return {camera.position_in_world(), glm::mat3(camera.world_from_camera) * in_camera / slant,
          camera.near_m * slant};
}

}  // namespace parvis::reference
