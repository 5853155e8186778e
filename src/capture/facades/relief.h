// The relief of the coarse model's surfaces: how far the place lies off each surface's plane. A flat stand-in
// shows a basin or a cornice of two photographs at two places; photographs agree on a surface only where it
// truly is.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "capture/facades/coarse_model.h"
#include "capture/facades/plane_sweep.h"
#include "capture/photographs/photograph.h"

namespace parvis::facades {

/// Heights over a rectangular surface, on a grid of side x side points that includes its edges.
struct Relief {
  SweptRectangle rectangle;
  SweptHeights found;

  /// A point of the relief; s and t in [0, 1] along u and v.
  glm::dvec3 at(double s, double t) const;
  /// Height at the grid point nearest to (s, t), and the least and greatest of those around it.
  glm::dvec3 heights_around(double s, double t) const;
};

/// A relief as triangles that are off by `tolerance` (world units) at most, without cracks: a
/// right-triangulated irregular network (Evans, Kirkpatrick and Townsend 2001). The grid has 2^n + 1 points
/// per side.
Mesh mesh_of(const Relief& relief, double tolerance);

/// The model's surfaces with their reliefs, named as they were.
struct ReliefModel {
  std::vector<NamedMesh> meshes;
  Errors notes;  ///< surfaces that lie on the relief of a larger one, and were left out
};

/// Sweeps walls and roofs that are rectangles; the ground and other polygons stay flat, and so does what
/// fewer than two photographs show from different places. `points` give the range of heights in front of each
/// surface and behind it.
ReliefModel with_reliefs(const CoarseModel& model, const photographs::PhotographSet& set,
                         std::span<const GreyPhoto> photos);

}  // namespace parvis::facades
