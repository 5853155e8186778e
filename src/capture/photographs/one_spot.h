// Cameras of photographs that were taken from one spot, for a panorama: rotations and one focal length from
// what pairs of photographs have in common. COLMAP cannot place such photographs: nothing in them has a
// parallax. After Brown and Lowe 2007, "Automatic panoramic image stitching using invariant features".
#pragma once

#include <glm/glm.hpp>
#include <utility>
#include <vector>

namespace parvis::photographs {

/// What two photographs have in common: pixels of the same things.
struct SpotPair {
  std::size_t a = 0, b = 0;
  std::vector<std::pair<glm::dvec2, glm::dvec2>> pixels;  ///< in a, in b; some may be wrong
};

/// The cameras, with principal points in the middle of their pictures.
struct SpotCameras {
  double focal_px = 0.0;
  std::vector<glm::dmat3>
      world_from_camera;        ///< the house's cameras: -z forward, y up; the first is identity
  std::vector<char> is_placed;  ///< 0: nothing in common with those of the first
  double error_px = 0.0;        ///< root mean square of what agrees
  std::size_t agreeing = 0;     ///< matches that do
};

/// Finds them: for focal lengths from 20 to 110 degrees of the picture's width, each pair's rotation from two
/// matches (RANSAC); the focal length for which most agree; a tree of the best pairs; all together by least
/// squares (Levenberg and Marquardt, with Huber's weights). `size`: of all pictures, pixels. `seed` makes it
/// repeatable. No photograph is placed where no pair has 12 matches that agree.
SpotCameras cameras_of_one_spot(std::size_t photographs, const std::vector<SpotPair>& pairs, glm::dvec2 size,
                                std::uint64_t seed = 1);

}  // namespace parvis::photographs
