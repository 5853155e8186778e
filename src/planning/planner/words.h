// The words of the window and of the planner's tool, in English and French.
#pragma once

#include <string>
#include <string_view>

namespace parvis::planner {

/// The languages of the window.
enum class Language : unsigned char { english, french };

/// The language of a locale's name: "fr_FR.UTF-8" is French, all else English.
Language language_of(std::string_view locale);

/// An English word or sentence of the window in a language; as it is where it has no translation.
std::string in_language(std::string_view english, Language language);

}  // namespace parvis::planner
