// The first bytes of a file, by which its format is known.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/result.h"

namespace parvis {

/// The first `count` bytes of a regular file, fewer where it is shorter. Errors are those of `read_file`.
Result<std::string> read_front(const std::filesystem::path& file, std::size_t count);

}  // namespace parvis
