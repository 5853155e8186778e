// The ground of a place, everywhere in it and around it: where the place has terrain, its heights; elsewhere
// what the feet of its buildings and its roads suggest.
#pragma once

#include <span>

#include "land/heights/height_raster.h"
#include "scene/data/scene.h"

namespace parvis::scene {

/// Heights of the ground over the plan of a scene's static, visible objects and a margin around it.
class PlaceHeights {
 public:
  /// `roads` are known ground, too: their centre lines lie on it. What surrounds the place (Surroundings)
  /// does not count. Without anything that stands still the ground is level at z = 0.
  PlaceHeights(const Scene& scene, std::span<const Road> roads, float margin_m);

  /// Height at a point, beyond the plan that of its nearest edge.
  float at(glm::vec2 point) const;
  /// The heights, all of them known.
  const HeightRaster& heights() const { return heights_m_; }
  /// 1 where the place has ground of its own: terrain, land use, road surfaces.
  const Mask& own_ground() const { return own_ground_; }
  /// 1 where something that is no ground stands or hangs above.
  const Mask& built() const { return built_; }

 private:
  void note_own_ground(const Object& object);
  void note_feet(const Object& object, HeightRaster& feet_m, HeightRaster& tops_m);
  void note_roads(std::span<const Road> roads);
  void note_lowest(const HeightRaster& feet_m, const HeightRaster& tops_m);
  void fill_gaps();

  HeightRaster heights_m_;
  Mask own_ground_, built_;
};

}  // namespace parvis::scene
