// Letters of a drawing's texts as polygons, through cairo.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "formats/drawings/drawing.h"

namespace parvis::plan_drawing {

/// The rings of each letter (even-odd rule), in the drawing's coordinates, first line at the insertion point.
/// Empty where the text has no height.
std::vector<std::vector<std::vector<glm::dvec3>>> text_outlines(const formats::DrawingText& text);

}  // namespace parvis::plan_drawing
