// The Intelligent Driver Model: how a driver accelerates, given the speed wanted and what is ahead.
// Treiber, Hennecke, Helbing 2000: Congested traffic states in empirical observations and microscopic
// simulations.
#pragma once

#include <algorithm>
#include <cmath>

namespace parvis::traffic {

struct Driver {
  float acceleration = 1.6f;    ///< a, m/s2
  float deceleration = 2.0f;    ///< b, comfortable, m/s2
  float time_gap_s = 1.3f;      ///< T, to the vehicle ahead
  float standing_gap_m = 2.0f;  ///< s0, bumper to bumper in a queue
};

inline constexpr float hardest_braking = 8.0f;  ///< m/s2, on dry asphalt

/// Acceleration on a free road, m/s2; `wanted` > 0.
inline float free_acceleration(const Driver& driver, float speed, float wanted) {
  const float ratio = speed / wanted;
  return std::max(driver.acceleration * (1.0f - ratio * ratio * ratio * ratio), -driver.deceleration);
}

/// Reduction of the free acceleration, m/s2, by an obstacle `gap_m` ahead that moves at `obstacle_speed`.
inline float interaction(const Driver& driver, float speed, float gap_m, float obstacle_speed) {
  const float approach =
      speed * (speed - obstacle_speed) / (2.0f * std::sqrt(driver.acceleration * driver.deceleration));
  const float wanted_gap_m = driver.standing_gap_m + std::max(0.0f, speed * driver.time_gap_s + approach);
  const float ratio = wanted_gap_m / std::max(gap_m, 0.01f);
  return driver.acceleration * ratio * ratio;
}

}  // namespace parvis::traffic
