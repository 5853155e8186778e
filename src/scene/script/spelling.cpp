#include "scene/script/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

namespace parvis::scene {
namespace {

/// Longer words are no misspelt names; more names than these are no scene made by hand. Both bound the time.
constexpr std::size_t longest_word = 40;
constexpr std::size_t max_words = 20'000;

char lower(char c) { return char(std::tolower(static_cast<unsigned char>(c))); }

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
  if (word.size() > longest_word) return "";
  const int tolerated = 1 + int(word.size()) / 3;
  const std::string* nearest = nullptr;
  int smallest = tolerated + 1;
  for (const std::string& name : known.first(std::min(known.size(), max_words))) {
    if (name.size() > longest_word) continue;
    const int distance = edit_distance(word, name);
    if (distance < smallest) smallest = distance, nearest = &name;
  }
  return nearest ? "; did you mean \"" + *nearest + "\"?" : "";
}

std::string thesis_class(std::string_view type) {
  std::string name = "xp" + std::string(type);
  if (name.size() > 2) name[2] = char(std::toupper(static_cast<unsigned char>(name[2])));
  return name;
}

std::array<std::string, 2> unique_names(std::string_view type) {
  return {fmt::format("%{}", type), fmt::format("%{}", thesis_class(type))};
}

}  // namespace parvis::scene
