// How high a terrain model stands at places on the map: what stands on it is put there.
#pragma once

#include <optional>

#include "land/heights/height_raster.h"
#include "scene/data/model.h"

namespace parvis::scene {

class TerrainHeights {
 public:
  /// Heights of the highest part of a georeferenced model that is ground (terrain, roads, land use).
  explicit TerrainHeights(const Model& terrain);

  /// Metres in the terrain's coordinates; nothing beyond it and in its holes.
  std::optional<double> at(glm::dvec2 on_map) const;
  /// Nothing where the model has no ground.
  std::optional<double> lowest() const;

 private:
  HeightRaster heights_m_;  ///< in the model's frame
  glm::dvec3 origin_;
};

}  // namespace parvis::scene
