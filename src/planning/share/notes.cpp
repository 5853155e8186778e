#include "planning/share/notes.h"

#include <algorithm>

#include "base/files.h"
#include "base/known_names.h"
#include "base/utf8.h"

namespace parvis::share {
namespace {

constexpr std::uint64_t max_bytes = 256 * 1024;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n"), last = text.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

}  // namespace

Result<std::vector<Note>> read_notes(const std::filesystem::path& file,
                                     const std::vector<std::string>& known) {
  const Result<std::string> text = read_file(file, max_bytes);
  if (!text) return text.errors();
  if (!is_utf8(*text)) return error("{}: is no text in UTF-8; save it so", file.string());
  std::vector<Note> notes;
  std::string paragraph;
  int line_number = 0, first_line = 1;
  const auto finish = [&]() -> Status {
    Note note{"", trimmed(paragraph)};
    paragraph.clear();
    if (note.text.empty()) return Ok{};
    if (const std::size_t end = note.text.find(']'); note.text.front() == '[' && end != std::string::npos) {
      note.about = note.text.substr(1, end - 1), note.text = trimmed(note.text.substr(end + 1));
      if (std::ranges::find(known, note.about) == known.end())
        return error_at({file.string(), first_line, 1},
                        "[{}]: the site has no view or scenario of this name{}", note.about.substr(0, 40),
                        names_that_exist(note.about, known));
    }
    notes.push_back(std::move(note));
    return Ok{};
  };
  std::size_t at = 0;
  while (at <= text->size()) {
    const std::size_t end = std::min(text->find('\n', at), text->size());
    const std::string line = trimmed(text->substr(at, end - at));
    ++line_number, at = end + 1;
    if (line.empty()) {
      if (Status status = finish(); !status) return status.errors();
      continue;
    }
    if (paragraph.empty()) first_line = line_number;
    paragraph += line + "\n";
  }
  if (Status status = finish(); !status) return status.errors();
  return notes;
}

}  // namespace parvis::share
