#include "scene/data/file_account.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/utf8.h"

namespace parvis::scene {
namespace {

/// "a, b, ..." of a line that counts more things than it names; empty where it names none.
std::string names_of(const AccountLine& line) {
  if (line.names.empty()) return "";
  return fmt::format(" ({}{})", fmt::join(line.names, ", "), line.count > line.names.size() ? ", ..." : "");
}

std::string sentence_of(const AccountLine& line) {
  return fmt::format("{} {} {}{}{}{}", line.count, line.kind, name_of(line.fate),
                     line.reason.empty() ? "" : ": ", line.reason, names_of(line));
}

/// The first bytes of a name, without those of a character that the end cuts.
std::string shortened(std::string_view name) {
  if (name.size() <= FileAccount::max_name_bytes) return std::string(name);
  std::size_t end = FileAccount::max_name_bytes;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0u) == 0x80u) --end;
  return std::string(name.substr(0, end)) + "...";
}

}  // namespace

const char* name_of(Fate fate) {
  constexpr const char* names[]{"used", "changed", "not needed", "left out"};
  return names[std::size_t(fate)];
}

void FileAccount::add(Fate fate, std::string_view kind, std::string_view reason, std::string_view name,
                      std::size_t count) {
  if (count == 0) return;
  const auto is_same = [&](const AccountLine& line) {
    return line.fate == fate && line.kind == kind && line.reason == reason;
  };
  auto line = std::ranges::find_if(lines_, is_same);
  if (line == lines_.end() && lines_.size() >= max_lines) {
    kind = "things of further kinds", reason = "";
    line = std::ranges::find_if(lines_, is_same);
  }
  if (line == lines_.end())
    line = lines_.insert(lines_.end(), {std::string(kind), fate, std::string(reason), 0, {}});
  line->count += count;
  last_ = std::size_t(line - lines_.begin());
  name_last(name);
}

void FileAccount::name_last(std::string_view name) {
  if (name.empty() || lines_.empty() || lines_[last_].names.size() >= max_names) return;
  std::vector<std::string>& names = lines_[last_].names;
  if (std::string text = shortened(name); std::ranges::find(names, text) == names.end())
    names.push_back(std::move(text));
}

void FileAccount::settle(std::string_view kind, std::size_t held, std::size_t came_out,
                         std::string_view reason) {
  used(kind, std::min(held, came_out));
  if (held > came_out) left_out(kind, reason, "", held - came_out);
}

std::size_t FileAccount::count(Fate fate, std::string_view kind) const {
  std::size_t sum = 0;
  for (const AccountLine& line : lines_)
    if (line.fate == fate && (kind.empty() || line.kind == kind)) sum += line.count;
  return sum;
}

Errors FileAccount::warnings() const {
  Errors warnings;
  std::map<std::string_view, std::size_t> of_kind;
  for (const AccountLine& line : lines_) {
    if (line.fate != Fate::left_out) continue;
    const auto [warning, is_new] = of_kind.try_emplace(line.kind, warnings.size());
    if (is_new)
      warnings.push_back({sentence_of(line), {file_, 0, 0}});
    else
      warnings[warning->second].message += "; " + sentence_of(line);
  }
  return warnings;
}

std::string FileAccount::text() const {
  std::string text = fmt::format("{}: {}\n", file_, format_);
  std::vector<const AccountLine*> sorted;
  sorted.reserve(lines_.size());
  for (const AccountLine& line : lines_) sorted.push_back(&line);
  std::ranges::stable_sort(sorted, {}, [](const AccountLine* line) { return line->fate; });
  for (const AccountLine* line : sorted) text += fmt::format("  {}\n", sentence_of(*line));
  return text;
}

void FileAccount::repair_names() {
  for (AccountLine& line : lines_) {
    repair_utf8(line.kind), repair_utf8(line.reason);
    for (std::string& name : line.names) repair_utf8(name);
  }
}

}  // namespace parvis::scene
