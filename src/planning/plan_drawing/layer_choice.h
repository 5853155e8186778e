// Which layers of a drawing are shown.
#pragma once

#include <string>
#include <vector>

#include "base/result.h"
#include "formats/drawings/drawing.h"

namespace parvis::plan_drawing {

/// The text without spaces around it.
std::string trimmed(const std::string& text);
/// The trimmed texts between commas, without empty ones.
std::vector<std::string> divided_at_commas(const std::string& text);

/// Whether each layer is shown: as the drawing has it, changed by `choice`, names or patterns separated by
/// commas, each hidden with a - before it ("-*, BATI, ARBRES": those two alone). Errors: a name that no layer
/// has, with those that there are.
Result<std::vector<bool>> shown_layers(const formats::Drawing& drawing, const std::string& choice);

}  // namespace parvis::plan_drawing
