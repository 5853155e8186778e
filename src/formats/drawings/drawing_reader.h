// Reads plan drawings (DXF, text and binary) in the isolated process.
#pragma once

#include <filesystem>
#include <optional>

#include "base/result.h"
#include "formats/drawings/drawing.h"

namespace parvis::formats {

/// Reads model space. `metres_per_unit`: in place of the unit that the file names. What is left out is in the
/// drawing's account (drawing_account.h); other warnings are added to `warnings`. Errors: no DXF, a cut or
/// damaged one, nothing drawn; a file that names no unit, with its extent in metres, centimetres and
/// millimetres; one that says inches and lies where Lambert-93 does in metres.
Result<Drawing> read_drawing(const std::filesystem::path& file, std::optional<double> metres_per_unit,
                             Errors& warnings);

/// The same in this process: for the worker, and for fuzzers.
Result<Drawing> parse_drawing(std::string_view bytes, const std::string& file,
                              std::optional<double> metres_per_unit, Errors& warnings);

}  // namespace parvis::formats
