// Letters of a drawing's texts as polygons, through cairo.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "base/result.h"
#include "formats/drawings/drawing.h"

namespace parvis::plan_drawing {

/// The rings of each letter (even-odd rule).
using TextOutlines = std::vector<std::vector<std::vector<glm::dvec3>>>;

/// An error where cairo cannot be loaded: to be asked before texts are shown.
Status letters_known();

/// The letters in the drawing's coordinates, first line at the insertion point. Empty where the text has no
/// height, or cairo cannot be loaded.
TextOutlines text_outlines(const formats::DrawingText& text);

}  // namespace parvis::plan_drawing
