// How high the ground lies along lanes.
#pragma once

#include "formats/terrain/height_raster.h"
#include "scene/data/scene.h"

namespace parvis::scene {

class GroundHeights {
 public:
  /// The ground within `reach_m`, in plan, of the scene's lanes: the highest static surface, at most 2.5 m
  /// above or below the nearest lane, that is no steeper than 45 degrees.
  GroundHeights(const Scene& scene, float reach_m);

  /// Height at a point; `fallback` where no ground is known.
  float at(glm::vec2 point, float fallback) const;

 private:
  void note_lanes(const RoadGraph& roads, float reach_m);
  void note_object(const Object& object);
  void note_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c);

  HeightRaster lane_heights_m_;  ///< of the nearest lane; NaN beyond reach
  HeightRaster heights_m_;
};

}  // namespace parvis::scene
