// Names of the files that a command writes beside the one it was given: a picture for each of several cameras
// or states, and what is kept until a picture or film is finished.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace parvis::stage {

/// A file for each of `names`, beside `output`: PICTURE.png and "oaks" make PICTURE-oaks.png where `joint` is
/// '-'. What no file should be called is replaced: '/' by '-', other signs and blanks by '_'. No two are the
/// same: a name that needs no replacement has its own file, and others that come to it get "-2", "-3".
std::vector<std::filesystem::path> series_files(const std::filesystem::path& output, char joint,
                                                const std::vector<std::string>& names);

/// Error: two of the files, read or written by one command, are one.
Status check_different(const std::vector<std::filesystem::path>& files);

/// `file` with `ending` after its extension (PICTURE.png.checkpoint). Where that is longer than names may be
/// (255 bytes), it is cut, with a hash of the whole.
std::filesystem::path file_beside(const std::filesystem::path& file, std::string_view ending);

}  // namespace parvis::stage
