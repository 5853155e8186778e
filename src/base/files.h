// Files: read whole, written whole or not at all, and never outside the roots that a scene may use.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace parvis {

Result<std::string> read_file(const std::filesystem::path& file);

/// Calls `write` with a temporary path beside `file` (same extension), then renames it to `file`. Removes the
/// temporary when `write` fails.
Status write_atomically(const std::filesystem::path& file,
                        const std::function<Status(const std::filesystem::path& temporary)>& write);
Status write_file(const std::filesystem::path& file, std::string_view text);

/// The folders that a scene may read from and write to: its own, and those given by --data.
class Roots {
 public:
  explicit Roots(std::filesystem::path scene_folder, std::vector<std::filesystem::path> data_folders = {});

  const std::filesystem::path& scene_folder() const { return folders_.front(); }

  /// The canonical path of `name` below the first root that holds it. A name that leads out of all roots
  /// (by "..", an absolute path or a link) and one that names no file are errors at `where`.
  Result<std::filesystem::path> find(const std::string& name, const FileLocation& where) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace parvis
