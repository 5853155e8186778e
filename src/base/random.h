// Seeded random numbers: PCG32 (O'Neill 2014), the same on every machine, unlike the standard distributions.
#pragma once

#include <cstdint>

namespace parvis {

class Random {
 public:
  explicit Random(std::uint64_t seed, std::uint64_t stream = 0) : increment_((stream << 1) | 1) {
    next(), state_ += seed, next();
  }

  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + increment_;
    const std::uint32_t mixed = std::uint32_t(((old >> 18) ^ old) >> 27);
    const std::uint32_t turn = std::uint32_t(old >> 59);
    return (mixed >> turn) | (mixed << ((32 - turn) & 31));
  }

  /// Uniform number in [0, 1).
  float uniform() { return float(next() >> 8) * 0x1p-24f; }
  /// Uniform number in [low, high).
  float uniform(float low, float high) { return low + (high - low) * uniform(); }
  /// Uniform integer in 0 .. count - 1; `count` > 0.
  int index(int count) { return int((std::uint64_t(next()) * std::uint64_t(count)) >> 32); }
  bool chance(float probability) { return uniform() < probability; }

 private:
  std::uint64_t state_ = 0;
  std::uint64_t increment_;
};

}  // namespace parvis
