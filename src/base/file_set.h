// Files that belong together: new ones take the places of old ones when all are whole.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis {

/// A file's path and future content.
struct FileContent {
  std::filesystem::path file;
  std::string bytes;
};

/// Writes all files beside their places, calls `before_they_appear`, and only then replaces what is there: on
/// a full disk, or where that fails, the old files stay together. Errors: as of PartialFile.
Status write_together(const std::vector<FileContent>& contents,
                      const std::function<Status()>& before_they_appear = {});

}  // namespace parvis
