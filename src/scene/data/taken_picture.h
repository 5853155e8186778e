// Pictures with known cameras, and the points that they show.
#pragma once

#include <string>
#include <vector>

#include "base/camera.h"

namespace parvis::scene {

/// A picture that a camera took.
struct TakenPicture {
  std::string name;  ///< of its file, or of its camera
  Camera camera;
  int width = 0, height = 0;
};

/// Focal length of its pinhole in pixels, the same along both axes.
double focal_length_px(const TakenPicture& picture);

/// A point of the scene, with the pictures that see it.
struct SeenPoint {
  glm::vec3 position;
  glm::u8vec3 colour;
  std::vector<int> pictures;  ///< indices into the pictures, ascending
};

/// Where a point falls in a picture, in pixels from its top left; what lies behind the camera falls nowhere
/// sensible.
glm::vec2 projected(const TakenPicture& picture, glm::vec3 position);

}  // namespace parvis::scene
