// The ground of a scene as people see it: static geometry, and where vehicles drive.
#pragma once

#include "life/crowd/nav_mesh.h"
#include "scene/data/scene.h"

namespace parvis::crowd {

/// The triangles of the scene's static, visible objects within `radius_m` of `centre` in plan, its trunks and
/// hedges as boxes, its lanes
/// and what materials call a road as roads, and the crossings of its streets. What surrounds the place
/// (scene::surrounds_place) does not count, nor what lies below ground.
WalkingGround ground_of(const scene::Scene& scene, glm::vec2 centre, float radius_m);

/// Heights of ground triangles, exact: those of the navigation mesh are off by up to 5 cm.
class GroundHeights {
 public:
  GroundHeights() = default;
  explicit GroundHeights(const WalkingGround& ground);

  /// The height of the highest triangle under a place, at most 0.3 m above it; the place's own where there is
  /// none within 0.5 m below it.
  float at(glm::vec3 place) const;

 private:
  std::vector<glm::vec3> corners_;
  std::vector<std::uint32_t> starts_, items_;  ///< triangles of cells, row by row; starts_ has one more
  glm::vec2 corner_{0.0f};
  glm::ivec2 size_{0};
  float cell_m_ = 1.0f;
};

}  // namespace parvis::crowd
