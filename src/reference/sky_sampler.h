// Directions to the sky, chosen as often as the sky shines from there.
#pragma once

#include <vector>

#include "shading/sky.h"

namespace parvis::reference {

class SkySampler {
 public:
  explicit SkySampler(const shading::SkyLight& sky);

  /// Is there any light in the sky? If not, nothing else may be asked.
  bool shines() const { return !row_ends_.empty(); }
  /// A unit direction in the world from two uniform numbers.
  glm::vec3 direction(glm::vec2 uniform) const;
  /// How densely `direction` chooses near a unit direction, per steradian.
  float density(glm::vec3 direction) const;

 private:
  float cell_density(int row, int column) const;

  int rows_, columns_;
  float heading_;
  std::vector<float> row_ends_;     ///< share of the light in rows 0 .. i
  std::vector<float> column_ends_;  ///< for each row, share of its light in columns 0 .. i
};

}  // namespace parvis::reference
