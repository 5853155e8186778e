// What of pavements and kerbs lies hidden below asphalt: in a crossing, the ribbons of turning lanes do.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>
#include <vector>

#include "scene/data/path.h"

namespace parvis::scene {

/// The asphalt of one lane.
struct AsphaltStrip {
  Path middle;  ///< points at most a few metres from each other
  float half_m = 0.0f;
};

/// The asphalt of all lanes.
class AsphaltCover {
 public:
  explicit AsphaltCover(const std::vector<AsphaltStrip>& strips);

  /// Whether other asphalt than that of the strip `own` lies over all of a piece of a ribbon, which reaches
  /// from left to right at its one end (`near`) and at its other (`far`). What lies more than a metre above
  /// or below is on another level. True is certain; pieces along which a seam of the asphalt runs may be said
  /// to be seen.
  bool hides(std::uint32_t own, glm::vec3 near_left, glm::vec3 near_right, glm::vec3 far_left,
             glm::vec3 far_right) const;

 private:
  struct Piece {
    glm::vec3 from, to;
    float half_m;
    std::uint32_t strip;
    bool is_first, is_last;  ///< asphalt ends there
  };

  bool is_over(std::uint32_t own, glm::vec3 point) const;

  std::vector<Piece> pieces_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;  ///< pieces over each cell
};

}  // namespace parvis::scene
