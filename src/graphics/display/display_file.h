// Displays as files: JSON of our own (docs/display.schema.json) and ParaView's .pvx.
#pragma once

#include <filesystem>

#include "graphics/display/display.h"

namespace parvis::display {

/// Reads a display, by the extension of its file's name (.json, .pvx). Errors name the file, and the wall and
/// the value that are wrong.
Result<Display> read_display(const std::filesystem::path& file);

/// The same from the text of a file of that name.
Result<Display> read_display_text(const std::string& text, const std::filesystem::path& file);

}  // namespace parvis::display
