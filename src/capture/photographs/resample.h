// Pictures read between their pixels.
#pragma once

#include <glm/glm.hpp>

#include "base/image.h"

namespace parvis::photographs {

/// The pixels beside a picture: its last column again, or, of a full turn, its first.
enum class Border { clamped, wraps_around };

/// The picture's four channels at `pixel` (centres at +0.5), by Catmull and Rom's spline over 4 x 4 pixels,
/// rounded.
void sample_bicubic(const Image8& rgba, glm::dvec2 pixel, Border border, std::uint8_t* out);

}  // namespace parvis::photographs
