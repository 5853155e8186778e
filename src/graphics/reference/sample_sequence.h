// Well spread random numbers for the samples of a pixel: Sobol's first two dimensions, scrambled and shuffled
// again for each use by hashes (Burley 2020, Practical Hash-based Owen Scrambling). Each number by itself is
// uniform, so that means stay unbiased.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace parvis::reference {

class SampleSequence {
 public:
  /// The numbers of sample `index` of a pixel; other seeds and pixels give independent ones.
  SampleSequence(std::uint64_t seed, std::uint32_t pixel, std::uint32_t index);

  /// A point in [0, 1)^2. The first 2^k samples of a pixel fall one into each cell of every grid of 2^k equal
  /// cells.
  glm::vec2 next_2d();
  float next_1d() { return next_2d().x; }

 private:
  std::uint32_t hash_, index_, use_ = 0;
};

}  // namespace parvis::reference
