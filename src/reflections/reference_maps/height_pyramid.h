// A heightfield that rays are traced through, with a pyramid of maxima over it. The C++ face of
// heightfield_walk.glsl.
#pragma once

#include <vector>

#include "graphics/shading/glsl.h"
#include "graphics/shading/heightfield.h"

namespace parvis::reference_maps {

/// What a ray hits; see heightfield_walk.glsl.
enum class Met { nothing, side, top };
struct HeightHit {
  float distance_m;  ///< along the unit direction; the reach where nothing is hit
  Met met;
};

class HeightPyramid {
 public:
  explicit HeightPyramid(const shading::Heightfield& heightfield);

  glm::vec2 origin() const { return origin_; }  ///< south-west corner, metres
  float cell_m() const { return cell_m_; }
  glm::ivec2 cells() const { return cells_; }
  /// Level 0 holds each cell's height, level n the highest of 2^n by 2^n cells. Sides are powers of two, as
  /// texture levels have them; what lies beyond the place is as low as can be.
  const std::vector<ImageF>& levels() const { return levels_; }

  // The nearest hit of a ray from `origin` along the unit vector `direction`, at most `reach_m` away. A ray
  // that starts below the top of its own cell leaves that cell freely.
  HeightHit walk(glm::vec3 origin, glm::vec3 direction, float reach_m) const;  ///< cell by cell
  HeightHit walk_by_levels(glm::vec3 origin, glm::vec3 direction,
                           float reach_m) const;  ///< the same, skipping
  /// As the paper does it: where the ray enters the first cell that is higher than the ray.
  HeightHit walk_to_cell(glm::vec3 origin, glm::vec3 direction, float reach_m) const;

 private:
  glm::vec2 origin_{0.0f};
  float cell_m_ = 1.0f;
  glm::ivec2 cells_{0};
  std::vector<ImageF> levels_;
};

}  // namespace parvis::reference_maps
