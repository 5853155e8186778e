// Where beside the lanes of a scene there is room for one more thing.
#pragma once

#include <cstdint>

#include "base/bounds.h"
#include "land/heights/ground_heights.h"
#include "land/heights/ground_raster.h"
#include "scene/data/scene.h"

namespace parvis::kerbside {

/// A plan of what is taken: carriageways, walls, and whatever else stands on the ground.
class FreeGround {
 public:
  /// Memory of the plan: a byte for each cell between the outermost lanes, inside `area`.
  static std::uint64_t bytes(const scene::RoadGraph& roads, const Bounds& area);
  /// The free ground of a scene whose lanes are laid. Things between 0.35 m and 3.5 m above the ground take
  /// their place; those that hang higher do not. Tunnels ("Road tunnel") have no room, nor have decks of
  /// bridges and their ramps ("Bridge") and the ground below them. Of trees that are grown plants, the trunks
  /// do. The plan ends with `area` (x and y), if the lanes reach farther: beyond it nothing is free.
  FreeGround(const scene::Scene& scene, const Bounds& area);
  /// An area without an end.
  static Bounds everywhere();

  /// No thing is within `radius_m` of a point in plan, no carriageway within `from_lanes_m` (0: that does
  /// not count), and no deck within `from_decks_m`.
  bool is_free(glm::vec2 point, float radius_m, float from_lanes_m, float from_decks_m) const;
  /// Takes the place within `radius_m` of a point.
  void take(glm::vec2 point, float radius_m);
  /// Height of the ground near a lane; the lane's own where none is known.
  float height(glm::vec2 point, float lane_m) const { return heights_.beside_lane(point, lane_m); }

 private:
  void take_lanes(const scene::RoadGraph& roads);
  void take_things(const scene::Scene& scene);
  void take_plants(const scene::Scene& scene);
  void take_triangle(glm::vec3 a, glm::vec3 b, glm::vec3 c);
  void take_floor(glm::vec3 a, glm::vec3 b, glm::vec3 c);
  void take_deck(glm::vec3 a, glm::vec3 b, glm::vec3 c);
  void mark(glm::vec2 point, float radius_m, unsigned char with);

  scene::GroundHeights heights_;
  float lowest_m_ = 0.0f, highest_m_ = 0.0f;  ///< between which something may stand on the ground
  scene::Mask taken_;  ///< of each cell: bit 0, a carriageway; bit 1, a thing; bit 2, a deck
};

}  // namespace parvis::kerbside
