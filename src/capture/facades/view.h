// The pinhole view of a calibrated, undistorted photograph in double precision: what the layer algorithms
// project with.
#pragma once

#include <glm/glm.hpp>

namespace parvis::facades {

/// Pixels from the top left, pixel centres at +0.5. In the camera's frame x is right, y down, z forward (the
/// axes of OpenCV and COLMAP); depth is z there, in world units.
struct View {
  glm::dmat3 camera_from_world{1.0};  ///< rotation
  glm::dvec3 centre{0.0};             ///< of projection, in world
  double fx = 1.0, fy = 1.0;          ///< focal lengths, pixels
  double cx = 0.0, cy = 0.0;          ///< principal point, pixels
  int width = 0, height = 0;

  glm::dvec3 to_camera(glm::dvec3 position_in_world) const {
    return camera_from_world * (position_in_world - centre);
  }
  /// The pixel of a point in the camera's frame with z > 0.
  glm::dvec2 to_pixel(glm::dvec3 position_in_camera) const {
    return {fx * position_in_camera.x / position_in_camera.z + cx,
            fy * position_in_camera.y / position_in_camera.z + cy};
  }
  /// The ray through a point of the picture, in the camera's frame, with z = 1.
  glm::dvec3 ray_in_camera(glm::dvec2 pixel) const { return {(pixel.x - cx) / fx, (pixel.y - cy) / fy, 1.0}; }
  /// The point at `depth` behind a point of the picture.
  glm::dvec3 to_world(glm::dvec2 pixel, double depth) const {
    return centre + glm::transpose(camera_from_world) * (depth * ray_in_camera(pixel));
  }
};

}  // namespace parvis::facades
