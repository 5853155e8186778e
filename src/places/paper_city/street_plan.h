// Plan of the paper's city (section 7): 1 km2 centred at the origin, four roads north and four roads east,
// blocks between them, and plots along every road.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace parvis::city {

inline constexpr float city_half_m = 500.0f;
inline constexpr float kerb_m = 0.15f;
inline constexpr int roads_each_way = 4;
inline constexpr int blocks_each_way = roads_each_way + 1;
inline constexpr float corner_cut_m = 2.7f;  ///< off both sides of a corner house

/// Cross-section of a road.
struct RoadProfile {
  float carriageway_m = 0.0f;
  float pavement_m = 0.0f;  ///< each side
  bool has_parking = false;

  /// Half of the width between the building lines.
  float half_width_m() const { return 0.5f * carriageway_m + pavement_m; }
};
inline constexpr RoadProfile wide_road{11.6f, 3.0f, true}, narrow_road{8.4f, 2.75f, false};

/// A straight road across the whole city.
struct Road {
  bool runs_north = false;  ///< else east
  float offset_m = 0.0f;    ///< of its middle: x where it runs north, y where it runs east
  RoadProfile profile;
};

/// Sides of a block, counter-clockwise, in the order of its corners.
enum Side : std::uint8_t { south, east, north, west };

/// A rectangle between roads or the city's edge.
struct Block {
  glm::vec2 min{0.0f}, max{0.0f};      ///< between the building lines
  std::array<const Road*, 4> roads{};  ///< by Side; null where the block ends at the city's edge
  bool is_park = false;
  int column = 0, row = 0;

  bool has_corner(int corner) const;  ///< corner i lies between sides i - 1 and i; both have roads
  glm::vec2 corner(int i) const;      ///< corner 0 is in the south-west
};

/// A frame on the ground: x along the facade, y inward from the street, z up.
struct Frame {
  glm::vec3 origin{0.0f}, along{1.0f, 0.0f, 0.0f}, inward{0.0f, 1.0f, 0.0f};

  /// Transforms a point from the frame to the model.
  glm::vec3 point(float x, float y, float z) const {
    return origin + along * x + inward * y + glm::vec3(0.0f, 0.0f, z);
  }
};

/// The ground of one house.
struct Plot {
  Frame frame;  ///< at the left front corner, on the pavement
  float width_m = 0.0f, depth_m = 0.0f;
  bool is_corner = false;  ///< square, with its cut corner at the right front
  bool has_left_neighbour = false, has_right_neighbour = false;
  int block = 0;
};

/// Roads, blocks and plots of the city.
struct StreetPlan {
  std::vector<Road> roads;    ///< those that run north, then those that run east, by offset
  std::vector<Block> blocks;  ///< row by row from the south-west
  std::vector<Plot> plots;    ///< plots of a row of houses are consecutive, from left to right
};

/// Crossing of the two wide roads, the centre of most views.
glm::vec2 main_crossing();

/// Generates the plan. Blocks point into `roads`: move a plan, do not copy it.
StreetPlan make_street_plan(std::uint64_t seed);

}  // namespace parvis::city
