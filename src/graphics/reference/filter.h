// Separable filters over float pictures, with the edge pixels repeated.
#pragma once

#include <vector>

#include "base/image.h"

namespace parvis::reference {

/// A kernel of odd length, its middle at the pixel.
using Kernel = std::vector<float>;

/// Convolves every channel with `along_x` and then `along_y`.
ImageF filtered(const ImageF& image, const Kernel& along_x, const Kernel& along_y);

/// exp(-x^2 / (2 sigma^2)) for |x| <= radius, of sum 1.
Kernel gaussian(float sigma, int radius);

}  // namespace parvis::reference
