// A calibrated view of a tree: a pinhole camera and an RGBA picture whose alpha is the tree's matte.
//
// Frames: the camera's is Parvis's (x right, y up, it looks along -z; base/camera.h). Pixels count from
// the top left corner, pixel centres at +0.5.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/camera.h"
#include "base/image.h"

namespace parvis::trees {

/// A half line; `direction` has unit length.
struct ViewRay {
  glm::vec3 origin, direction;
};

/// A camera without distortion, with everything that the inner loops need, in single precision.
struct Pinhole {
  int width = 0, height = 0;          ///< pixels
  glm::vec2 focal{1.0f};              ///< pixels
  glm::vec2 principal_point{0.0f};    ///< pixels from the top left corner
  glm::mat3 world_from_camera{1.0f};  ///< rotation
  glm::vec3 position_in_world{0.0f};  ///< metres

  /// The pixel of a point in the world (x, y) and its distance along the axis in metres (z; not positive:
  /// behind the camera, and x, y mean nothing).
  glm::vec3 project(glm::vec3 in_world) const {
    const glm::vec3 p = (in_world - position_in_world) * world_from_camera;
    const float depth = -p.z, inverse = depth > 0.0f ? 1.0f / depth : 0.0f;
    return {principal_point.x + focal.x * p.x * inverse, principal_point.y - focal.y * p.y * inverse, depth};
  }
  /// The direction in the world of a pixel, unit length.
  glm::vec3 direction(glm::vec2 pixel) const {
    return glm::normalize(world_from_camera * glm::vec3((pixel.x - principal_point.x) / focal.x,
                                                        (principal_point.y - pixel.y) / focal.y, -1.0f));
  }
  /// The half line from the camera through a pixel.
  ViewRay ray(glm::vec2 pixel) const { return {position_in_world, direction(pixel)}; }
  /// The direction of the optical axis in the world.
  glm::vec3 forward() const { return -world_from_camera[2]; }
};

/// The pinhole of a house camera with a picture of this size.
Pinhole pinhole_of(const Camera& camera, int width, int height);
/// The same camera with a picture `factor` times smaller each way (sizes are rounded up).
Pinhole reduced(const Pinhole& camera, int factor);

/// A photograph of the tree with its camera.
struct TreeView {
  std::string name;  ///< of the photograph, as errors call it
  Pinhole camera;
  Image8 picture;  ///< RGBA, straight alpha, sRGB: pure foreground and matte
};

/// Mean of alpha over blocks of factor x factor pixels (fewer at the right and lower edge), one channel,
/// 0..1.
ImageF reduced_alpha(const Image8& rgba, int factor);

/// The point nearest to all optical axes, in the sense of least squares; the mean position where the axes are
/// parallel.
glm::vec3 point_looked_at(std::span<const TreeView> views);

}  // namespace parvis::trees
