// Smaller pictures, averaged as light adds up.
#pragma once

#include "base/image.h"

namespace parvis {

/// A picture of 1/n the width and height: each pixel is the mean of n x n. `n` >= 1; rows and columns beyond
/// the last whole n are left out.
ImageF reduced(const ImageF& fine, int n);

/// The same of bytes: each pixel is the mean of n x n in display-linear light (bytes of
/// sRGB are no amounts of light: their mean darkens every edge); alpha counts as it stands.
Image8 reduced(const Image8& srgb, int n);

}  // namespace parvis
