#include "planning/design/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <utility>

#include "base/content_hash.h"
#include "base/files.h"

namespace parvis::design {
namespace {

constexpr std::string_view head = "parvis design journal ";
constexpr int version = 1;
constexpr std::uint64_t max_journal_bytes = 256u << 20;
constexpr const char* move_it =
    "; it is left as it is, with the steps that it holds: move it away to begin a new one";
constexpr std::array<const char*, 4> words{"do", "undo", "redo", "saved"};

/// One line: the hash of what it says, then that; line feeds are written as "\n".
std::string line_of(std::string_view word, std::string_view text) {
  std::string said(word);
  if (!text.empty()) said += ' ';
  for (const char c : text)
    if (c == '\n')
      said += "\\n";
    else if (c == '\\')
      said += "\\\\";
    else
      said += c;
  return hash_of(said) + " " + said + "\n";
}

std::string unescaped(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] != '\\' || i + 1 == text.size())
      result += text[i];
    else
      result += text[++i] == 'n' ? '\n' : text[i];
  return result;
}

/// The content of a whole, undamaged line.
std::optional<std::string_view> said_by(std::string_view line) {
  constexpr std::size_t digits = 16;
  if (line.size() < digits + 2 || line[digits] != ' ') return std::nullopt;
  const std::string_view said = line.substr(digits + 1);
  return hash_of(said) == line.substr(0, digits) ? std::optional(said) : std::nullopt;
}

Status write_all(int file, std::string_view bytes, const std::filesystem::path& path) {
  const off_t before = lseek(file, 0, SEEK_END);
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      const int reason = errno;
      if (ftruncate(file, before) != 0) return error("{}: the journal cannot be written", path.string());
      return error("{}: the journal cannot be written ({}); make room, then try again", path.string(),
                   std::strerror(reason));
    }
    bytes.remove_prefix(std::size_t(written));
  }
  if (fdatasync(file) != 0) return error("{}: {}", path.string(), std::strerror(errno));
  return Ok{};
}

}  // namespace

std::string hash_of(std::string_view text) {
  ContentHash hash;
  hash.add_text(text);
  return fmt::format("{:016x}", hash.value());
}

Result<JournalContent> read_journal(const std::filesystem::path& file) {
  const Result<std::string> text = read_file(file, max_journal_bytes);
  if (!text) return text.errors();
  JournalContent content;
  std::string_view rest = *text;
  int number = 0;
  bool has_base = false;
  while (!rest.empty()) {
    const std::size_t end = rest.find('\n');
    const std::string_view line = rest.substr(0, end);
    const bool is_whole = end != std::string_view::npos;
    rest.remove_prefix(is_whole ? end + 1 : rest.size());
    ++number;
    const FileLocation where{file.string(), number, 1};
    if (number == 1) {
      if (!line.starts_with(head)) return error_at(where, "this is no journal of a design{}", move_it);
      const std::string wanted = std::string(line.substr(head.size()));
      if (std::strtol(wanted.c_str(), nullptr, 10) > version)
        return error_at(where,
                        "the journal is of a newer version of this program ({}); open it with that one",
                        wanted.substr(0, 20));
      continue;
    }
    const std::optional<std::string_view> said = is_whole ? said_by(line) : std::nullopt;
    if (!said) {
      if (!rest.empty()) return error_at(where, "this line of the journal is damaged{}", move_it);
      content.is_cut = true;
      break;
    }
    const std::size_t blank = std::min(said->find(' '), said->size());
    const std::string_view word = said->substr(0, blank);
    const std::string argument = unescaped(said->substr(std::min(blank + 1, said->size())));
    if (word == "name")
      content.name = argument;
    else if (word == "base")
      content.base = argument, has_base = true;
    else if (const auto known =
                 std::ranges::find(words, word, [](const char* each) { return std::string_view(each); });
             known != words.end())
      content.entries.push_back({JournalEntry::What(known - words.begin()), argument});
    else
      return error_at(where, "\"{}\" is no word of a journal", word.substr(0, 20));
  }
  if (!has_base)
    return error_at({file.string(), number, 1}, "the journal ends before its first entry{}", move_it);
  return content;
}

Journal& Journal::operator=(Journal&& other) noexcept {
  std::swap(file_, other.file_), std::swap(path_, other.path_);
  return *this;
}

Journal::~Journal() {
  if (file_ >= 0) close(file_);
}

Result<Journal> Journal::begin(const std::filesystem::path& file, const std::string& name,
                               const std::string& base) {
  // Whole or not at all: a journal without its base is of no use.
  const std::string text =
      std::string(head) + std::to_string(version) + "\n" + line_of("name", name) + line_of("base", base);
  if (Status status = write_file(file, text); !status) return status.errors();
  return lock(file);
}

Result<Journal> Journal::lock(const std::filesystem::path& file) {
  Journal journal;
  journal.path_ = file;
  journal.file_ = open(file.c_str(), O_RDWR | O_APPEND | O_CLOEXEC | O_NOFOLLOW);
  if (journal.file_ < 0)
    return error("{}: the journal cannot be opened: {}", file.string(), std::strerror(errno));
  struct stat opened {
  }, there{};
  const bool is_ours = flock(journal.file_, LOCK_EX | LOCK_NB) == 0 && fstat(journal.file_, &opened) == 0 &&
                       stat(file.c_str(), &there) == 0 && opened.st_ino == there.st_ino;
  if (!is_ours)
    return error("{}: this design is being worked on in another window or program; close it there first",
                 file.string());
  return journal;
}

Status Journal::drop_cut_line() {
  const Result<std::string> text = read_file(path_, max_journal_bytes);
  if (!text) return text.errors();
  const std::size_t whole = text->rfind('\n') + 1;
  if (whole < text->size() && ftruncate(file_, off_t(whole)) != 0)
    return error("{}: {}", path_.string(), std::strerror(errno));
  return Ok{};
}

Status Journal::append(const JournalEntry& entry) {
  if (!is_open()) return Ok{};
  return write_all(file_, line_of(words[std::size_t(entry.what)], entry.text), path_);
}

}  // namespace parvis::design
