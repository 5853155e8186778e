// Places at equal distances along the kerbs of a scene's streets.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "places/kerbside/free_ground.h"

namespace parvis::kerbside {

/// Part of a plan, metres.
struct Circle {
  glm::vec2 middle{0.0f};
  float radius_m = 0.0f;

  bool contains(glm::vec2 point) const { return glm::distance(point, middle) <= radius_m; }
};

/// The spacing of a series, and its distances to other things. Metres.
struct KerbSeries {
  float spacing_m = 9.0f;
  float beside_m = 0.9f;              ///< from the edge of the lane outward; below 0: on the lane
  float half_length_m = 0.0f;         ///< along the kerb
  float radius_m = 0.5f;              ///< about the line along that length nothing else may stand
  float from_lanes_m = 0.2f;          ///< about that line there is no carriageway
  float from_decks_m = 0.5f;          ///< and no deck of a bridge: crowns are wide
  float share = 1.0f;                 ///< of the places: the others stay free
  bool stands_on_wide_lanes = false;  ///< on lanes of 4.8 m and more, beside the kerb, as parked cars do
  std::optional<Circle> circle = {};  ///< in which it stands; without one: everywhere
};

/// One of them.
struct KerbPlace {
  glm::vec3 foot{0.0f};
  glm::vec2 along{1.0f, 0.0f};  ///< the direction of the lane, unit length
  bool is_left = false;         ///< of the lane
  float rise = 0.0f;            ///< of the ground below the thing, along the lane: metres up per metre
};

/// The places of a series that are free, each of which is taken at once. Ends of lanes, where drivers look
/// into crossings, stay free; so do lanes of more than 81 km/h.
std::vector<KerbPlace> take_kerb_places(const scene::RoadGraph& roads, const KerbSeries& series,
                                        FreeGround& ground);

}  // namespace parvis::kerbside
