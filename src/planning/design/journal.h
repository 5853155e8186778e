// The journal of a design: each command is on disk before its effect is shown, so that whoever is killed at
// any moment goes on where they were, and steps can be undone after closing and opening.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace parvis::design {

/// The content of one line of a journal.
struct JournalEntry {
  enum class What : std::uint8_t { command, undo, redo, saved };
  What what = What::command;
  std::string text = {};  ///< of a command; of `saved`: the hash of the design that was written
};

/// A journal as it lies on disk.
struct JournalContent {
  std::string base;  ///< the script of the design before the first entry
  std::string name;  ///< of the design
  std::vector<JournalEntry> entries;
  bool is_cut = false;  ///< its last line is not whole: it was being written when the program ended
};

/// A hash of a text, as journals write it.
std::string hash_of(std::string_view text);

/// Reads a journal. Errors: no journal of this program, one of a newer version, a damaged line before the
/// last.
Result<JournalContent> read_journal(const std::filesystem::path& file);

/// An open journal, to which lines are appended.
class Journal {
 public:
  Journal() = default;  ///< writes nothing
  /// Begins a new journal for a design whose script is `base`; `file` does not exist.
  static Result<Journal> begin(const std::filesystem::path& file, const std::string& name,
                               const std::string& base);
  /// Opens one to go on with it, and keeps others from writing it meanwhile; an error where another does.
  static Result<Journal> lock(const std::filesystem::path& file);
  /// Takes off a last line that was not written to its end.
  Status drop_cut_line();
  Journal(Journal&& other) noexcept { *this = std::move(other); }
  Journal& operator=(Journal&& other) noexcept;
  ~Journal();

  bool is_open() const { return file_ >= 0; }                  ///< else nothing is written
  const std::filesystem::path& path() const { return path_; }  ///< of its file
  /// Appends a line and makes sure that it is on the disk. On an error (a full disk) the journal is as
  /// before.
  Status append(const JournalEntry& entry);

 private:
  int file_ = -1;
  std::filesystem::path path_;
};

}  // namespace parvis::design
