// Notes of the authors of a design, for those who look at it without them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::share {

/// A paragraph; `about` names a view or a scenario, or is empty.
struct Note {
  std::string about, text;
};

/// Reads a text file in UTF-8 whose paragraphs are parted by empty lines. One that begins with a name in
/// brackets,
/// "[street] ...", is about the view or scenario of that name. Errors: the file cannot be read, is larger
/// than 256 KB, is no UTF-8, or names what is not among `known`.
Result<std::vector<Note>> read_notes(const std::filesystem::path& file,
                                     const std::vector<std::string>& known);

}  // namespace parvis::share
