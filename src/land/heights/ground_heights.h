// How high the ground lies along lanes.
#pragma once

#include "land/heights/height_raster.h"
#include "scene/data/scene.h"

namespace parvis::scene {

/// How far the ground of a road may lie above or below it, metres: beyond are roofs, cellars, and other roads
/// of bridges and tunnels.
inline constexpr float ground_reach_m = 2.5f;
/// The same on a bridge, beyond which are its parapets.
inline constexpr float deck_reach_m = 0.5f;

/// The ground, without what stands on it. Models with names of city surfaces say themselves what is ground
/// (and bridges are); of other models it is what lies level and is larger than furniture, cars and crowns:
/// heights are grown to regions that no step bounds, and small regions on top of others are things. Leaves,
/// hidden objects and dynamic ones are no ground.
class GroundHeights {
 public:
  /// The ground within `reach_m`, in plan, of the scene's lanes, at most `ground_reach_m` above or below the
  /// nearest lane and no steeper than 45 degrees; the highest where several lie above each other.
  GroundHeights(const Scene& scene, float reach_m);

  /// Height at a point; `fallback` where no ground is known.
  float at(glm::vec2 point, float fallback) const;
  /// Height at a point of a lane or beside it; the lane's own, `lane_m`, where the ground that is known lies
  /// farther from it than `ground_reach_m`: there another lane, of a bridge or tunnel, runs above or below.
  float beside_lane(glm::vec2 point, float lane_m) const;

 private:
  void note_lanes(const RoadGraph& roads, float reach_m);
  void note_object(const Object& object, HeightRaster& unnamed_m);
  void note_triangle(HeightRaster& heights_m, glm::vec3 a, glm::vec3 b, glm::vec3 c, float reach_m);
  void add_without_things(HeightRaster unnamed_m);

  HeightRaster lane_heights_m_;  ///< of the nearest lane; NaN beyond reach
  HeightRaster heights_m_;
};

}  // namespace parvis::scene
