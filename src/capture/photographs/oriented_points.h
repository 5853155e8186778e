// The points of a set with normals: from the plane of each point's neighbours, towards the cameras that see
// it.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "capture/photographs/photograph.h"

namespace parvis::photographs {

/// Eigenvalues (rising) and unit eigenvectors of a symmetric matrix.
struct Eigensystem {
  glm::dvec3 values;
  glm::dmat3 vectors;  ///< columns, in the order of the values
};
/// The eigensystem of a symmetric matrix with finite entries.
Eigensystem eigen_of(const glm::dmat3& m);

/// A point with the plane of its neighbours.
struct OrientedPoint {
  glm::dvec3 position;  ///< in world
  glm::dvec3 normal;    ///< unit, towards the cameras that see it
  double flatness;      ///< 0: its neighbours scatter in all directions; 1: they lie in a plane
  int views = 1;        ///< photographs that see it, 1 where nobody noted
};

/// The points of a set with normals, from their 12 nearest neighbours. Points that fewer than two photographs
/// see are left out where observations are known; normals point to the cameras that observe a point, or to
/// the nearest camera. Of more than 40,000 points every n-th is taken.
std::vector<OrientedPoint> oriented_points(const PhotographSet& set);

/// The median distance of an observation, from the camera to the point (to the nearest camera where nobody
/// noted who sees a point); 0 without points.
double viewing_distance(const PhotographSet& set);

}  // namespace parvis::photographs
