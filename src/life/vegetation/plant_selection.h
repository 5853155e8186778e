// What one view draws of all plants, within a budget of primitives.
#pragma once

#include <span>
#include <vector>

#include "graphics/render/culling.h"
#include "life/vegetation/plant_levels.h"
#include "life/vegetation/scene_plant.h"

namespace parvis::vegetation {

/// A plant of the scene as views ask for it.
struct PlacedPlant {
  const PlantShape* shape = nullptr;  ///< not owned
  glm::mat4 world_from_plant{1.0f};
  float scale = 1.0f;  ///< the largest of the placement
  Bounds bounds;       ///< in the world; empty where it is hidden
  int thing = 0;       ///< number behind the scene's objects
  bool is_visible = true;
  bool is_newcomer = false;  ///< appeared or was moved in this frame
  bool casts_shadow = true;
};

/// The plant as it stands, numbered.
PlacedPlant placed(const ScenePlant& plant, int thing);

/// Leaves of one plant, or of one cluster of it, with the forms in which they are drawn.
struct SelectedLeaves {
  std::uint32_t plant;
  std::int32_t cluster;  ///< -1: the whole plant, by points
  float pixels_per_metre;
  LeafShares shares;
};
/// Wood of one plant.
struct SelectedWood {
  std::uint32_t plant;
  float pixels_per_metre;
  WoodShares shares;
};

/// Counts of drawn primitives.
struct PlantStatistics {
  std::size_t triangles = 0, points = 0, lines = 0;
  std::size_t all() const { return triangles + points + lines; }  ///< their sum
};

/// Chooses for one view; keeps its memory from view to view.
class PlantSelection {
 public:
  /// Every plant in the view at the forms that its size asks for; where they are more primitives than the
  /// view may have, all of them as if the picture were so much smaller that they are not.
  void choose(std::span<const PlacedPlant> plants, const render::View& view, const render::Culling& culling,
              const PlantDetail& detail);

  const std::vector<SelectedLeaves>& leaves() const { return leaves_; }  ///< nearest first
  const std::vector<SelectedWood>& wood() const { return wood_; }        ///< by plant
  const PlantStatistics& statistics() const { return statistics_; }      ///< of all of it
  /// Factor to the resolution, at most 1, by which the budget was kept.
  float scale() const { return scale_; }

 private:
  void gather(const render::View& view, const render::Culling& culling, const PlantDetail& detail);
  void share_out(float scale);

  std::span<const PlacedPlant> plants_;
  bool is_full_ = false, is_mirrored_ = false;
  float scale_ = 1.0f;
  std::vector<SelectedLeaves> leaves_;
  std::vector<SelectedWood> wood_;
  PlantStatistics statistics_;
};

}  // namespace parvis::vegetation
