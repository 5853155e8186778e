// Which level of detail of a city object is shown.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

namespace parvis::scene {

/// The highest of the levels, or the highest not above `maximum`; where all are above it, the lowest. Nothing
/// where there are none.
inline std::optional<double> wanted_level(const std::vector<double>& levels, std::optional<double> maximum) {
  std::optional<double> best;
  for (const double level : levels)
    if ((!maximum || level <= *maximum) && (!best || level > *best)) best = level;
  if (!best && !levels.empty()) best = *std::min_element(levels.begin(), levels.end());
  return best;
}

}  // namespace parvis::scene
