// Shell patterns over names: '*' stands for any text, '?' for one character.
#pragma once

#include <string_view>

namespace parvis::scene {

/// False for a plain name, which matches itself alone.
inline bool is_pattern(std::string_view text) { return text.find_first_of("*?") != std::string_view::npos; }

/// Takes at most pattern.size() * name.size() steps.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace parvis::scene
