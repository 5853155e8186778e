// Pictures that a visitor takes: numbered files beside each other, none of them ever written over.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "base/result.h"

namespace parvis::viewer {

/// Has `write` write "NAME-0001.png", or the first number after the highest there is in `folder`, which is
/// made where it is not there; gives the file's path. A file that somebody else makes meanwhile stays as it
/// is.
Result<std::filesystem::path> write_numbered(
    const std::filesystem::path& folder, const std::string& name,
    const std::function<Status(const std::filesystem::path&)>& write);

}  // namespace parvis::viewer
