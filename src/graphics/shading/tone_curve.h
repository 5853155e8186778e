// C++ face of tone_curve.glsl.
#pragma once

#include "base/image.h"
#include "graphics/shading/glsl.h"

namespace parvis::shading {
#include "graphics/shading/tone_curve.glsl"

/// The 8-bit sRGB picture of a linear radiance picture (3 or 4 channels) at an exposure.
Image8 tone_mapped_picture(const ImageF& radiance, float exposure);

}  // namespace parvis::shading
