// Text of DXF files as UTF-8: code pages, and characters written as \U+00E9.
#pragma once

#include <string>
#include <string_view>

#include "formats/drawings/group_codes.h"

namespace parvis::formats {

/// A value as UTF-8. One that is valid UTF-8 is taken as such, whatever its file says of its code page;
/// others are of Windows' code page 1252. Characters written as \U+00E9 (pairs of surrogates, too) become
/// themselves; control characters become spaces.
std::string decoded(std::string_view value);

/// `decoded` of all values of a file. Warns, at `file`, where bytes are of a code page other than 1252
/// (`code_page`, "ANSI_1251").
void decode_texts(GroupCodes& codes, std::string_view code_page, const std::string& file, Errors& warnings);

}  // namespace parvis::formats
