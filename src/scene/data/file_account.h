// The account of a file: what it holds, what of it a model shows, what was changed and what was left out, by
// kind, count and the first few names.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace parvis::scene {

/// The fate of a thing that a file holds.
enum class Fate : std::uint8_t {
  used,
  changed,   ///< shown in another way than the file says
  unneeded,  ///< the file itself has no use for it: texture coordinates without a texture
  left_out   ///< lost
};

/// "used", "changed", "not needed", "left out".
const char* name_of(Fate fate);

/// Things of one kind that met the same fate for the same reason.
struct AccountLine {
  std::string kind;  ///< plural, in the words of the format: "nodes", "IfcWall", "tags roof:angle"
  Fate fate = Fate::used;
  std::string reason;  ///< ends a sentence: "is not decoded"; empty for what is used as it is
  std::size_t count = 0;
  std::vector<std::string> names;  ///< of the first few, each once
};

/// An account has no default: each reader writes one. Things of a kind that the file holds are the sum of its
/// lines of that kind, so what goes in comes out or is named.
class FileAccount {
 public:
  /// No more names a line, lines, and bytes a name are kept: a hostile file has millions.
  static constexpr std::size_t max_names = 4, max_lines = 200, max_name_bytes = 60;

  /// `format`: as a user calls it: "glTF 2.0".
  explicit FileAccount(std::string format) : format_(std::move(format)) {}

  const std::string& format() const { return format_; }             ///< as users call it
  const std::vector<AccountLine>& lines() const { return lines_; }  ///< in the order of their first things
  const std::string& file() const { return file_; }                 ///< its path, as messages name it
  /// Sets the file's name; called by the registry alone.
  void set_file(std::string file) { file_ = std::move(file); }

  /// Counts things that the model shows as they are; 0 of a kind makes no line.
  void used(std::string_view kind, std::size_t count = 1) { add(Fate::used, kind, "", "", count); }
  /// Counts things that the model shows in another way than the file says: the reason says how.
  void changed(std::string_view kind, std::string_view reason, std::string_view name = "",
               std::size_t count = 1) {
    add(Fate::changed, kind, reason, name, count);
  }
  /// Counts things that nothing in the file makes use of, or that it hides.
  void unneeded(std::string_view kind, std::string_view reason, std::string_view name = "",
                std::size_t count = 1) {
    add(Fate::unneeded, kind, reason, name, count);
  }
  /// Counts things that the model does not show.
  void left_out(std::string_view kind, std::string_view reason, std::string_view name = "",
                std::size_t count = 1) {
    add(Fate::left_out, kind, reason, name, count);
  }
  /// Counts what a library was given of a kind, and what came out of it: the difference was left out by it.
  void settle(std::string_view kind, std::size_t held, std::size_t came_out, std::string_view reason);
  /// Counts things with any fate.
  void add(Fate fate, std::string_view kind, std::string_view reason, std::string_view name,
           std::size_t count);
  /// Adds a name to the line that was added to last.
  void name_last(std::string_view name);

  /// Things of a kind with a fate; of all kinds where `kind` is empty.
  std::size_t count(Fate fate, std::string_view kind = "") const;
  /// The short form: one warning a kind of things that were left out.
  Errors warnings() const;
  /// The whole, a line of text each: "  12 images left out: KTX2 is not decoded (a.ktx2, b.ktx2, ...)".
  std::string text() const;
  /// Replaces what is no UTF-8 in names and kinds.
  void repair_names();

 private:
  std::string format_, file_;
  std::vector<AccountLine> lines_;
  std::size_t last_ = 0;  ///< line that was added to
};

}  // namespace parvis::scene
