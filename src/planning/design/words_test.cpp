#include "planning/design/words.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <vector>

namespace parvis::design {
namespace {

std::vector<std::string> placeholders(std::string_view text) {
  static const std::regex braces("\\{[^}]*\\}");
  const std::string searched(text);
  std::vector<std::string> found;
  for (std::sregex_iterator it(searched.begin(), searched.end(), braces), end; it != end; ++it)
    found.push_back(it->str());
  return found;
}

TEST(Words, TranslationsTakeTheSameArguments) {
  std::set<std::string_view> known;
  for (const auto& [english, french] : french_words()) {
    EXPECT_EQ(placeholders(english), placeholders(french)) << english;
    EXPECT_TRUE(known.insert(english).second) << "twice: " << english;
  }
}

TEST(Words, FrenchHasDecimalCommas) {
  EXPECT_EQ(words_in(Language::french).format("by {:.2f} m", 0.4), "de 0,40 m");
  EXPECT_EQ(Words().format("by {:.2f} m", 0.4), "by 0.40 m");
  EXPECT_EQ(words_in(Language::french).format("{} h. {:g}", 3, 2.0), "3 h. 2");
}

}  // namespace
}  // namespace parvis::design
