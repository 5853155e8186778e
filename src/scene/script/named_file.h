// Files that scripts name: where they are looked for.
#pragma once

#include <filesystem>
#include <string>

#include "base/files.h"
#include "base/result.h"

namespace parvis::scene {

/// The canonical path of the file or folder that the script `where.file` calls `name`: relative to the
/// script's own folder, or, where that holds none of this name, to the first of the roots that does. A script
/// that is included thus brings its files along, whoever includes it. What lies outside all roots is refused
/// either way. Errors at `where`.
Result<std::filesystem::path> find_named_file(const std::string& name, const Roots& roots,
                                              const FileLocation& where);

}  // namespace parvis::scene
