// A file that appears under its name when it is whole, or not at all.
#pragma once

#include <filesystem>
#include <string_view>

#include "base/result.h"

namespace parvis {

/// A new, empty file beside the one that it becomes: hidden, same extension, of a name that nobody can guess,
/// opened by nobody else. Links are not followed. Unless `keep` is called, the destructor removes it, and a
/// signal that ends the program does (`remove_partial_files_on_signals`); what a program that was killed has
/// left is removed by the next one that writes the same file.
class PartialFile {
 public:
  /// Makes the folders above `file`. A link at `file` keeps its place: what it points to is replaced. Errors:
  /// a folder that cannot be made or written to; something at `file` that is no regular file; a link that
  /// leads out of its folder.
  static Result<PartialFile> create(const std::filesystem::path& file);
  PartialFile(PartialFile&& other) noexcept;
  PartialFile& operator=(PartialFile&&) = delete;
  ~PartialFile();

  /// Where to write.
  const std::filesystem::path& path() const { return partial_; }
  /// Writes `bytes` in place of what is there.
  Status write(std::string_view bytes) const;
  /// Makes sure that the bytes are on the disk: a full one may say so only now.
  Status sync() const;
  /// `sync`, then takes the place of the file, with its permissions if there was one.
  Status keep();

 private:
  PartialFile(std::filesystem::path file, std::filesystem::path partial, int slot, int lock)
      : file_(std::move(file)), partial_(std::move(partial)), slot_(slot), lock_(lock) {}

  std::filesystem::path file_, partial_;
  int slot_;  ///< in the list of what a signal removes; -1: none
  int lock_;  ///< descriptor of the file while it is worked on
};

/// Whether nobody works on a partial file or folder any more: who does holds a lock on it.
bool is_abandoned(const std::filesystem::path& path);

/// A new, empty folder of a name that nobody can guess, for files that later move to their places. The
/// destructor removes it with all that is in it, and so does a signal that ends the program (its files, not
/// folders inside it).
class PartialFolder {
 public:
  /// Creates the partial folder inside `folder`, which must exist. Errors: it cannot be written to.
  static Result<PartialFolder> create(const std::filesystem::path& folder);
  PartialFolder(PartialFolder&& other) noexcept;
  PartialFolder& operator=(PartialFolder&&) = delete;
  ~PartialFolder();

  /// Where to write.
  const std::filesystem::path& path() const { return folder_; }

 private:
  PartialFolder(std::filesystem::path folder, int slot, int lock)
      : folder_(std::move(folder)), slot_(slot), lock_(lock) {}

  std::filesystem::path folder_;
  int slot_;  ///< in the list of what a signal removes; -1: none
  int lock_;  ///< descriptor of the folder while it is worked on; -1: none
};

/// Installs handlers: SIGINT, SIGTERM and SIGHUP remove all partial files and folders, say so, and end the
/// program with status 1. Commands that finish or resume their work in another way may handle SIGINT and
/// SIGTERM themselves.
void remove_partial_files_on_signals();

/// Removes all partial files and folders, says `message` on the standard error and ends the program with
/// status 1 at once: for signals, and where memory ends in code that may not throw. Allocates nothing.
[[noreturn]] void remove_partial_files_and_end(std::string_view message);

}  // namespace parvis
