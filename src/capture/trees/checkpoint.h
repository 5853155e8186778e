// Parts of long work that are done, or how far they are, in a folder: the same command goes on where it was
// interrupted.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.h"

namespace parvis::trees {

/// A folder with a sealed file (base/sealed_file.h) for each part. A part is found again under the key that
/// it was kept with, a hash of all that it depends on. Nothing is kept, found or removed through a link.
class Checkpoint {
 public:
  /// Keeps nothing and finds nothing.
  Checkpoint() = default;
  /// Keeps parts in `folder`, which the first of them makes; an empty path keeps nothing.
  explicit Checkpoint(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Does it keep anything?
  bool keeps_parts() const { return !folder_.empty(); }
  /// Where it does.
  const std::filesystem::path& folder() const { return folder_; }

  /// What was kept of a part under this key. None where nothing was, where it is of other work, and, with a
  /// warning, where it is damaged.
  std::optional<std::string> find(const std::string& part, std::uint64_t key) const;
  /// Keeps a part in place of what was kept under its name, whole or not at all. Any thread may. Errors: what
  /// the disk says; a link, or something else, lies in its place. What was kept before stays.
  Status keep(const std::string& part, std::uint64_t key, std::string_view content) const;
  /// Removes all parts: the work is done. The folder goes, too, unless somebody keeps something else there.
  void remove() const;

 private:
  std::filesystem::path file(const std::string& part) const;

  std::filesystem::path folder_;
};

}  // namespace parvis::trees
