// A height field for ray casting, with a pyramid of maxima. C++ side of heightfield_walk.glsl.
#pragma once

#include <vector>

#include "graphics/shading/glsl.h"
#include "graphics/shading/heightfield.h"

namespace parvis::reference_maps {

/// The thing that a ray hits: nothing, the vertical side of a cell, or its top; see heightfield_walk.glsl.
enum class HitKind { nothing, side, top };
/// Result of casting a ray.
struct HeightHit {
  float distance_m;  ///< along the unit direction; the reach if nothing is hit
  HitKind kind;
};

/// Heights on a grid of square cells, as columns with flat tops.
class HeightPyramid {
 public:
  /// Copies the heights and computes the pyramid.
  explicit HeightPyramid(const shading::Heightfield& heightfield);

  glm::vec2 origin() const { return origin_; }  ///< south-west corner, metres
  float cell_m() const { return cell_m_; }      ///< side of a cell at level 0
  glm::ivec2 cells() const { return cells_; }   ///< at level 0, without the padding to powers of two
  /// Level 0 holds the height of each cell, level n the maximum over 2^n by 2^n cells. Sides are powers of
  /// two, as texture levels require; the padding has the lowest float.
  const std::vector<ImageF>& levels() const { return levels_; }

  // Nearest hit of a ray from `origin` along the unit vector `direction`, at most `reach_m` away. A ray that
  // starts below the top of its own cell leaves that cell without a hit.
  HeightHit walk(glm::vec3 origin, glm::vec3 direction, float reach_m) const;  ///< cell by cell
  /// The same result, skipping empty space by the pyramid.
  HeightHit walk_by_levels(glm::vec3 origin, glm::vec3 direction, float reach_m) const;
  /// The paper's variant: the point where the ray enters the first cell that is higher than the ray.
  HeightHit walk_to_cell(glm::vec3 origin, glm::vec3 direction, float reach_m) const;

 private:
  glm::vec2 origin_{0.0f};
  float cell_m_ = 1.0f;
  glm::ivec2 cells_{0};
  std::vector<ImageF> levels_;
};

}  // namespace parvis::reference_maps
