// How two of several probes share the reflections of a body.
#pragma once

#include <algorithm>
#include <optional>

namespace parvis::probes {

/// The share, 0 to 1/2, that the second nearest probe has of a body so far from the nearest three, metres. It
/// begins at nothing where the third is as near as the second, so that nothing jumps where they change
/// places. `third_m`: none, where there are only two.
inline float share_of_second(float nearest_m, float second_m, std::optional<float> third_m) {
  const float reach_m = std::max(third_m.value_or(nearest_m + second_m), 1e-3f);
  const float nearest = std::max(1.0f - nearest_m / reach_m, 1e-3f),
              second = std::max(1.0f - second_m / reach_m, 0.0f);
  return second / (nearest + second);
}

}  // namespace parvis::probes
