// FLIP: A Difference Evaluator for Alternating Images (Andersson, Nilsson, Akenine-Moeller, Oskarsson,
// Astroem, Fairchild, HPG 2020), for low dynamic range.
#pragma once

#include "base/image.h"

namespace parvis::reference {

/// The error of each pixel, 0..1, of two sRGB pictures of one size at 67 pixels a degree.
ImageF flip(const Image8& test, const Image8& reference);

}  // namespace parvis::reference
