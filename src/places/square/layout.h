// Where things lie in the square: houses about it and along the streets that lead out. x east, y north; the
// middle of the fountain is near the origin, carriageways lie at z = 0.
#pragma once

#include <cstdint>
#include <vector>

#include "places/square/facade.h"

namespace parvis::square {

inline constexpr float kerb_m = 0.12f;  ///< pavements and the square above the carriageways

/// Building lines of the square, and of the streets that lead out of it.
inline constexpr float west_m = -48.0f, east_m = 48.0f, south_m = -34.0f, north_m = 34.0f;
inline constexpr float avenue_y = -26.25f, avenue_north_line_m = -18.5f;  ///< along the southern side
inline constexpr float street_x = 40.25f, street_west_line_m = 32.5f;     ///< along the eastern side
inline constexpr float lane_x = -18.0f, lane_half_m = 7.5f;               ///< leads out southward
inline constexpr float tram_y = 14.0f, tram_x = 6.0f,
                       tram_half_m = 6.5f;  ///< comes from the west, turns north
inline constexpr float reach_m = 178.0f;    ///< to the houses that close the streets
inline constexpr glm::vec2 fountain_at{-8.0f, -4.0f};

/// A house: a rectangle in plan with its front on the street.
struct Building {
  Frame frame;  ///< at the left corner of the front
  float width_m = 10.0f, depth_m = 13.0f;
  FacadeStyle style;
  int bays = 3;
  bool has_left_front = false, has_right_front = false;  ///< facades on its sides, too
  bool closes_left = false, closes_right = false;        ///< its gallery ends there, before a wall
  bool is_on_square = false;
};

/// All houses, from a seed.
std::vector<Building> plan_houses(std::uint64_t seed);

}  // namespace parvis::square
