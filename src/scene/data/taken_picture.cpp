#include "scene/data/taken_picture.h"

#include <cmath>

namespace parvis::scene {

double focal_length_px(const TakenPicture& picture) {
  return 0.5 * double(picture.height) / std::tan(0.5 * double(picture.camera.vertical_fov));
}

glm::vec2 projected(const TakenPicture& picture, glm::vec3 position) {
  const glm::dvec4 p = glm::inverse(glm::dmat4(picture.camera.world_from_camera)) * glm::dvec4(position, 1.0);
  const double focal = focal_length_px(picture);
  return {float(0.5 * picture.width - focal * p.x / p.z), float(0.5 * picture.height + focal * p.y / p.z)};
}

}  // namespace parvis::scene
