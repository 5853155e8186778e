// Pictures of noise maps, to be read by people.
#pragma once

#include <functional>

#include "base/image.h"
#include "planning/noise/noise_map.h"

namespace parvis::noise {

/// A step of a scale: values from `from`, up to the next step's.
struct ScaleStep {
  double from;
  glm::u8vec3 colour;  ///< sRGB
};

/// North up: each cell in the colour of its step, buildings grey, with the scale and a bar of metres below.
/// `value`: of a cell; nothing where a building stands.
Image8 noise_picture(const NoiseMap& map, const std::string& title, std::span<const ScaleStep> scale,
                     const std::function<std::optional<double>(int column, int row)>& value);

/// The colour of a value's step.
glm::u8vec3 colour_of_value(double value, std::span<const ScaleStep> scale);

/// Steps of 5 dB from 35 dB(A), in an order that is also one of lightness.
std::span<const ScaleStep> level_scale();
/// Differences in dB: blue where it is quieter, red where it is louder.
std::span<const ScaleStep> difference_scale();

}  // namespace parvis::noise
