// Colour: linear Rec. 709 inside, sRGB in 8-bit pictures (IEC 61966-2-1).
#pragma once

#include <glm/glm.hpp>

#include "base/image.h"

namespace parvis {

/// sRGB decoding of one value: 0..1 to linear 0..1 (IEC 61966-2-1).
float linear_from_srgb(float srgb);
/// sRGB encoding of one value, the inverse of `linear_from_srgb`; 0..1 is not enforced.
float srgb_from_linear(float linear);
/// sRGB decoding, channel by channel.
glm::vec3 linear_from_srgb(glm::vec3 srgb);
/// sRGB encoding, channel by channel.
glm::vec3 srgb_from_linear(glm::vec3 linear);

/// The linear colour of "#RRGGBB" or of three sRGB bytes in 0..255.
glm::vec3 linear_from_srgb8(int red, int green, int blue);

/// Relative luminance of a linear Rec. 709 colour.
float luminance(glm::vec3 linear);

/// Encodes a display-referred linear picture (values clamped to 0..1) as 8-bit sRGB; alpha stays linear.
Image8 srgb8_from_linear(const ImageF& linear);
/// Decodes an 8-bit sRGB picture; alpha stays linear.
ImageF linear_from_srgb8(const Image8& srgb);

}  // namespace parvis
