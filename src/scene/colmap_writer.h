// Photographs with known cameras as a COLMAP text model (cameras.txt, images.txt, points3D.txt):
// https://colmap.github.io/format.html. The world stays as it is: metres, z up.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/camera.h"
#include "base/result.h"

namespace parvis::scene {

/// A picture that a camera took.
struct TakenPicture {
  std::string name;  ///< of its file, or of its camera
  Camera camera;
  int width = 0, height = 0;
};

/// A point of the scene, with the pictures that see it.
struct SeenPoint {
  glm::vec3 position;
  glm::u8vec3 colour;
  std::vector<int> pictures;  ///< indices into the pictures, ascending
};

/// Where a point falls in a picture, in pixels from its top left; what lies behind the camera falls nowhere
/// sensible.
glm::vec2 projected(const TakenPicture& picture, glm::vec3 position);

/// Writes the three files into `folder`. Pictures of one size and field of view share a COLMAP camera.
Status write_colmap(const std::filesystem::path& folder, const std::vector<TakenPicture>& pictures,
                    const std::vector<SeenPoint>& points);

}  // namespace parvis::scene
