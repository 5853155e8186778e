// The borders of where the middles of bodies may be, as segments in plan.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

namespace parvis::crowd {

/// A border; metres in plan. People are to the left of the way from `a` to `b`.
struct Wall {
  glm::vec2 a, b;
  float bottom_m = -1e9f, top_m = 1e9f;  ///< heights between which it stands
};

/// How a place lies to a wall.
struct WallContact {
  glm::vec2 inward{0.0f};   ///< unit vector, away from the wall
  float distance_m = 0.0f;  ///< negative behind it
};
/// Nothing where the place lies before or beyond the wall's ends: else a corner, passed at no distance, would
/// stop who walks along the wall that ends there.
std::optional<WallContact> contact_with(const Wall& wall, glm::vec2 place);

/// The point of a segment nearest to `p`.
glm::vec2 nearest_on_segment(glm::vec2 a, glm::vec2 b, glm::vec2 p);

/// Walls in cells, so that those near a place are found at once.
class Walls {
 public:
  Walls() = default;
  /// Cells are so wide that walls within `reach_m` of a place are among those of its cell.
  Walls(std::vector<Wall> walls, float reach_m);

  /// Indices of the walls that may lie within the reach of a place.
  std::span<const std::uint32_t> near(glm::vec2 place) const;
  const std::vector<Wall>& all() const { return walls_; }  ///< in the order given
  /// Does the way from `from` to `to` cross a wall at this height?
  bool crosses(glm::vec2 from, glm::vec2 to, float height_m) const;

 private:
  glm::ivec2 cell_of(glm::vec2 place) const;

  std::vector<Wall> walls_;
  std::vector<std::uint32_t> starts_, items_;  ///< of cells, row by row; starts_ has one more
  glm::vec2 corner_{0.0f};
  glm::ivec2 size_{0};
  float cell_m_ = 1.0f;
};

}  // namespace parvis::crowd
