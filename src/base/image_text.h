// Words in pictures: the labels of plans and scales.
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "base/image.h"

namespace parvis {

/// Writes one line into an RGBA picture, `height_px` high, in sRGB: `at` is the left end of its baseline,
/// from the top left corner. What lies outside is left out. On a machine without a font nothing is written.
void write_text(Image8& picture, glm::ivec2 at, const std::string& text, int height_px, glm::u8vec3 colour);

/// How wide that line is, in pixels; 0 without a font.
int text_width(const std::string& text, int height_px);

}  // namespace parvis
