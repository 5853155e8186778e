// Colours of layers in maps and figures.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace parvis::facades {

/// Colours that differ between neighbours in a list: the golden section turns the hue.
inline std::array<std::uint8_t, 3> layer_colour(std::size_t number) {
  const double hue = 6.0 * (0.61803398875 * double(number) - std::floor(0.61803398875 * double(number)));
  const auto channel = [&](double shift) {
    const double h = std::fmod(hue + shift, 6.0);
    return std::uint8_t(80.0 + 160.0 * std::clamp(std::abs(h - 3.0) - 1.0, 0.0, 1.0));
  };
  return {channel(0.0), channel(4.0), channel(2.0)};
}

}  // namespace parvis::facades
