// Shell patterns over names: '*' stands for any text, '?' for one character.
#pragma once

#include <string_view>

namespace parvis::scene {

/// Takes at most pattern.size() * name.size() steps.
bool matches(std::string_view pattern, std::string_view name);

}  // namespace parvis::scene
