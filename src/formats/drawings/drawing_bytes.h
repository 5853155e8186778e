// Drawings as flat bytes: how they come back from the process that reads a file.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"
#include "formats/drawings/drawing.h"

namespace parvis::formats {

/// The whole drawing; numbers as they lie in memory.
std::string bytes_of(const Drawing& drawing);

/// The drawing that `bytes_of` has written. The bytes are not trusted: counts are checked before anything is
/// allocated, layers before they are used. `subject` stands in errors.
Result<Drawing> drawing_of(std::string_view bytes, const std::string& subject);

}  // namespace parvis::formats
