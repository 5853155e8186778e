#include "scene/data/building_kind.h"

#include <algorithm>
#include <charconv>

#include "base/result.h"

namespace parvis::scene {
namespace {

// By the value of each class; the first is "unknown" and has no word.
constexpr std::array<std::string_view, 7> epochs{"",          "before-1870", "1870-1918", "1919-1945",
                                                 "1946-1974", "1975-1999",   "since-2000"};
constexpr std::array<std::string_view, 7> uses{"",         "dwelling", "shop",  "office",
                                               "industry", "shed",     "church"};
constexpr std::array<std::string_view, 7> finishes{"",         "brick", "plaster", "stone",
                                                   "concrete", "metal", "wood"};
constexpr std::array<std::string_view, 9> tints{"",    "white", "grey",  "dark", "yellow",
                                                "red", "brown", "green", "blue"};
constexpr std::array<int, 5> first_years{1870, 1919, 1946, 1975, 2000};  // of the epochs after the first
constexpr std::string_view storeys_word = "-storeys";

template <class Class, std::size_t count>
void find(std::string_view word, const std::array<std::string_view, count>& words, Class& value) {
  if (const auto found = std::find(words.begin() + 1, words.end(), word); found != words.end())
    value = Class(found - words.begin());
}

void find_storeys(std::string_view word, std::uint8_t& storeys) {
  if (!word.ends_with(storeys_word)) return;
  word.remove_suffix(storeys_word.size());
  std::uint8_t count = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), count);
  if (problem == std::errc() && end == word.data() + word.size()) storeys = count;
}

}  // namespace

BuildingEpoch epoch_of(int year) {
  const auto next = std::ranges::upper_bound(first_years, year);
  return BuildingEpoch(1 + (next - first_years.begin()));
}

std::string words_of(const BuildingKind& kind) {
  std::string words;
  const auto add = [&](std::string_view word) {
    if (word.empty()) return;
    if (!words.empty()) words += ' ';
    words += word;
  };
  add(uses[std::size_t(kind.use)]), add(epochs[std::size_t(kind.epoch)]);
  add(finishes[std::size_t(kind.finish)]), add(tints[std::size_t(kind.tint)]);
  if (kind.storeys > 0) add(fmt::format("{}{}", int(kind.storeys), storeys_word));
  return words;
}

BuildingKind kind_of_words(std::string_view name) {
  BuildingKind kind;
  while (!name.empty()) {
    const std::string_view word = name.substr(0, name.find(' '));
    find(word, uses, kind.use), find(word, epochs, kind.epoch);
    find(word, finishes, kind.finish), find(word, tints, kind.tint);
    find_storeys(word, kind.storeys);
    name.remove_prefix(std::min(name.size(), word.size() + 1));
  }
  return kind;
}

BuildingKind completed(BuildingKind own, const BuildingKind& whole) {
  if (own.use == BuildingUse::unknown) own.use = whole.use;
  if (own.epoch == BuildingEpoch::unknown) own.epoch = whole.epoch;
  if (own.finish == WallFinish::unknown) own.finish = whole.finish;
  if (own.tint == WallTint::unknown) own.tint = whole.tint;
  if (own.storeys == 0) own.storeys = whole.storeys;
  return own;
}

}  // namespace parvis::scene
