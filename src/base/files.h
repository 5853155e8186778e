// Files: read whole, written whole or not at all, and never outside the roots that a scene may use.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace parvis {

/// Larger files are refused where no other limit is given: a place of a whole town takes less.
inline constexpr std::uint64_t max_file_bytes = std::uint64_t{4} << 30;

/// The bytes of a regular file. Refused are folders, devices, pipes and sockets, which may hang or never end,
/// and files of more than `max_bytes`; a read that fails half way is an error, too.
Result<std::string> read_file(const std::filesystem::path& file, std::uint64_t max_bytes = max_file_bytes);

/// Makes the folders above `file`, calls `write` with the path of a new, empty file beside it (hidden, same
/// extension), makes sure that its bytes are on the disk and renames it to `file`. An existing file keeps its
/// permissions, and a link its place: what it points to is replaced. Nothing is left behind when `write`
/// fails or the disk is full.
Status write_atomically(const std::filesystem::path& file,
                        const std::function<Status(const std::filesystem::path& temporary)>& write);
/// Writes `text` in the same way.
Status write_file(const std::filesystem::path& file, std::string_view text);

/// The folders that a scene may read from and write to: its own, and those given by --data.
class Roots {
 public:
  explicit Roots(std::filesystem::path scene_folder, std::vector<std::filesystem::path> data_folders = {});

  /// The scene's own folder: the first root that `find` searches.
  const std::filesystem::path& scene_folder() const { return folders_.front(); }

  /// The canonical path of `name` below the first root that holds it. Errors at `where`: a name that leads
  /// out of all roots (by "..", an absolute path or a link), one that names no file, and one that is neither
  /// a regular file nor a folder.
  Result<std::filesystem::path> find(const std::string& name, const FileLocation& where) const;

 private:
  std::vector<std::filesystem::path> folders_;
};

}  // namespace parvis
