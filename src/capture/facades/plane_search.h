// Planes of a place in its sparse points: ground, walls, roofs. Robust fits (Fischler and Bolles 1981:
// RANSAC) with one point and its normal per hypothesis (Schnabel, Wahl and Klein 2007, section 4), walls
// vertical.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "capture/photographs/oriented_points.h"

namespace parvis::facades {

/// The kind of surface that a plane is part of. A slope rises from the ground: stairs, a ramp, a bank. It is
/// found as a roof; its foot on the ground distinguishes it (coarse_model.h).
enum class SurfaceKind { ground, wall, roof, slope };

/// A plane { p : dot(normal, p) = offset } with the points that lie in it.
struct FoundPlane {
  SurfaceKind kind = SurfaceKind::wall;
  glm::dvec3 normal{0.0};  ///< unit, towards the cameras
  double offset = 0.0;
  std::vector<std::size_t> inliers;  ///< into the points, each in one plane only
};

/// The ground, if any, then walls and roofs by falling number of points. `tolerance` is how far (metres) a
/// point may lie off its plane. Wall directions within 4 degrees of one common right-angled grid are turned
/// to it.
std::vector<FoundPlane> find_planes(const std::vector<photographs::OrientedPoint>& points, glm::dvec3 up,
                                    double tolerance, const std::vector<glm::dvec3>& camera_positions);

}  // namespace parvis::facades
