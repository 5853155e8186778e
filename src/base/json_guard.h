// JSON of users' files: guarded before it is parsed, and its problems in words.
#pragma once

#include <string>
#include <string_view>

#include "base/result.h"

namespace parvis {

/// Lists and objects in each other that JSON may have: deeper ones overflow the stack of whoever walks,
/// copies or prints them. The formats that are read here need less than 30.
inline constexpr int max_json_depth = 200;

/// Refuses text whose brackets, those in strings apart, stand more than `max_json_depth` deep in each other.
/// To be asked before parsing; whether the text is JSON at all is for the parser to say.
Status check_json_depth(std::string_view text, const std::string& subject);

/// The message of a JSON library's exception, without its own name and number for it.
std::string json_reason(std::string_view what);

}  // namespace parvis
