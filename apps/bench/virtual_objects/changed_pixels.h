// Where something changes what mirrors show.
#pragma once

#include "base/image.h"

namespace parvis::bench {

/// The pixels of mirrors where two true pictures differ, with something and without it, and what lies within
/// 3 pixels: where it is mirrored, and where a method may show it wrongly. A channel, 255 or 0.
Image8 changed_pixels(const Image8& with, const Image8& without, const Image8& mirrors);

}  // namespace parvis::bench
