// The words of the window, the planner's tool and the sheets, in English and French.
#pragma once

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace parvis::design {

/// The languages of what people read.
enum class Language : unsigned char { english, french };

/// The language of a locale's name: "fr_FR.UTF-8" is French, all else English.
Language language_of(std::string_view locale);

/// An English word or sentence in a language; as it is where it has no translation.
std::string in_language(std::string_view english, Language language);

/// All translations: English, French.
std::span<const std::pair<std::string_view, std::string_view>> french_words();

/// The words of one language, for code that cannot link this room: modules. By itself English.
struct Words {
  std::string (*translation)(std::string_view english) = nullptr;

  /// An English word or sentence in this language.
  std::string operator()(std::string_view english) const {
    return translation ? translation(english) : std::string(english);
  }
  /// An English format with its arguments, numbers and units, in this language: French has decimal commas.
  template <class... Arguments>
  std::string format(std::string_view english, const Arguments&... arguments) const {
    std::string text = fmt::format(fmt::runtime((*this)(english)), arguments...);
    for (std::size_t i = 1; translation && i + 1 < text.size(); ++i)
      if (text[i] == '.' && is_digit(text[i - 1]) && is_digit(text[i + 1])) text[i] = ',';
    return text;
  }

 private:
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }
};

/// Those of a language.
Words words_in(Language language);

}  // namespace parvis::design
