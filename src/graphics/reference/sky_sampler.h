// Directions to the sky, chosen as often as the sky shines from there.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "graphics/shading/sky.h"

namespace parvis::reference {

class SkySampler {
 public:
  explicit SkySampler(const shading::SkyLight& sky);

  /// Is there any light in the sky? If not, nothing else may be asked.
  bool shines() const { return !row_density_.empty(); }
  struct Choice {
    glm::vec3 direction;  ///< unit, in the world
    glm::vec2 uv;         ///< where it falls in the picture
    float density;        ///< per steradian
  };
  /// Chooses a direction from two uniform numbers.
  Choice choose(glm::vec2 uniform) const;
  /// How densely `choose` chooses near a place of the picture, per steradian.
  float density(glm::vec2 uv) const;

 private:
  /// Shares of 1 that lie side by side, and where to begin the search for the one that holds a number.
  struct Shares {
    std::vector<float> ends;             ///< a row of the picture after the other
    std::vector<std::uint16_t> guesses;  ///< the first share that ends beyond k / count
  };
  static bool accumulate(Shares& shares, std::size_t first, std::size_t count);
  static std::pair<int, float> find(const Shares& shares, std::size_t first, std::size_t count,
                                    float uniform);
  float cell_density(int row, int column) const;

  int rows_, columns_;
  float heading_;
  Shares vertical_;                 ///< of the light in rows
  Shares horizontal_;               ///< for each row, of its light in columns
  std::vector<float> row_cosines_;  ///< of the polar angles between which rows lie
  std::vector<float> row_density_;  ///< per steradian, where a row's light is even
};

}  // namespace parvis::reference
