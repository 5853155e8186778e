#include "base/known_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace parvis {
namespace {

namespace fs = std::filesystem;

/// Longer words are no misspelt names; more names than these are no scene made by hand. Both bound the time.
constexpr std::size_t longest_word = 40;
constexpr std::size_t max_words = 20'000;
constexpr std::size_t max_listed = 10;
constexpr std::size_t max_shown = 60;  ///< characters of a name

char lower(char c) { return char(std::tolower(static_cast<unsigned char>(c))); }

bool holds(std::string_view name, std::string_view word) {
  const auto is_same = [](char a, char b) { return lower(a) == lower(b); };
  return !word.empty() && !std::ranges::search(name, word, is_same).empty();
}

/// The name that is near enough to `word` to be meant; null if there is none.
const std::string* nearest_name(std::string_view word, std::span<const std::string> known) {
  if (word.size() > longest_word) return nullptr;
  const int tolerated = 1 + int(word.size()) / 3;
  const std::string* nearest = nullptr;
  int smallest = tolerated + 1;
  for (const std::string& name : known.first(std::min(known.size(), max_words))) {
    if (name.size() > longest_word || name.empty()) continue;
    const int distance = edit_distance(word, name);
    if (distance < smallest) smallest = distance, nearest = &name;
  }
  return nearest;
}

/// Each name once, in the order in which they are listed.
std::vector<std::string_view> nearest_first(std::string_view word, std::span<const std::string> known) {
  struct Ranked {
    int rank;
    std::string_view name;
  };
  std::string plain(word);
  std::erase_if(plain, [](char c) { return c == '*' || c == '?'; });
  std::vector<Ranked> ranked;
  std::set<std::string_view> seen;
  for (const std::string& name : known) {
    if (name.empty() || !seen.insert(name).second) continue;
    const bool is_ranked =
        word.size() <= longest_word && name.size() <= longest_word && ranked.size() < max_words;
    ranked.push_back({holds(name, plain) ? 0
                      : is_ranked        ? edit_distance(word, name)
                                         : 2 * int(longest_word),
                      name});
  }
  std::ranges::stable_sort(ranked, {}, &Ranked::rank);
  std::vector<std::string_view> names;
  names.reserve(ranked.size());
  for (const Ranked& each : ranked) names.push_back(each.name);
  return names;
}

std::string in_quotes(std::string_view name) {
  return fmt::format("\"{}{}\"", name.substr(0, max_shown), name.size() > max_shown ? "..." : "");
}

/// `"a", "b" and 12 others`.
std::string listed(std::span<const std::string_view> names) {
  // One name takes no more space than "1 other".
  const std::size_t count = names.size() <= max_listed + 1 ? names.size() : max_listed;
  std::string list;
  for (std::size_t i = 0; i < count; ++i) list += (i > 0 ? ", " : "") + in_quotes(names[i]);
  return count == names.size() ? list : fmt::format("{} and {} others", list, names.size() - count);
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = int(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, above), std::swap(above, row);
    row[0] = int(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = above[j - 1] + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string did_you_mean(std::string_view word, std::span<const std::string> known) {
  const std::string* nearest = nearest_name(word, known);
  return nearest ? "; did you mean " + in_quotes(*nearest) + "?" : "";
}

std::string names_that_exist(std::string_view word, std::span<const std::string> known) {
  std::vector<std::string_view> names = nearest_first(word, known);
  if (names.empty()) return "; there is none";
  const std::string* nearest = nearest_name(word, known);
  if (!nearest) return fmt::format("; there {} {}", names.size() > 1 ? "are" : "is", listed(names));
  std::erase(names, std::string_view(*nearest));
  const std::string meant = did_you_mean(word, known);
  if (names.empty()) return meant;
  return fmt::format("{} There {} also {}", meant, names.size() > 1 ? "are" : "is", listed(names));
}

std::string missing_folder(const fs::path& folder) {
  std::error_code code;
  if (fs::is_directory(folder, code)) return "";
  if (fs::exists(folder, code)) return "it is a file; expected a folder";
  fs::path there = fs::absolute(folder, code).lexically_normal();
  if (!there.has_filename()) there = there.parent_path();  // "data/"
  std::string missing;
  while (!fs::is_directory(there, code) && there.has_relative_path())
    missing = there.filename().string(), there = there.parent_path();
  std::vector<std::string> names;
  for (fs::directory_iterator entry(there, code), end; !code && entry != end && names.size() < max_words;
       entry.increment(code)) {
    std::error_code ignored;
    const std::string name = entry->path().filename().string();
    if (!name.starts_with('.') && entry->is_directory(ignored)) names.push_back(name);
  }
  std::ranges::sort(names);  // the order of a file system is none
  return fmt::format("{} has no folder \"{}\"{}", there.string(), missing, names_that_exist(missing, names));
}

}  // namespace parvis
