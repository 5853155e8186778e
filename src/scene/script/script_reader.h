// The scene language's grammar (thesis, appendix A):
//   script    = { node }
//   node      = type "(" [ attribute { "," attribute } [","] ] ")" [ "{" { node } "}" ]
//   attribute = name "=" ( word | string )
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "scene/script/script_syntax.h"

namespace parvis::scene {

/// Limits that no honest script meets; they bound the time and memory of a hostile one.
inline constexpr std::size_t max_script_bytes = 64u << 20;
inline constexpr int max_script_depth = 64;
inline constexpr std::size_t max_script_items = 500'000;  ///< nodes and attributes of one file

/// Reads the script `text`; `file` stands in errors. After an error reading goes on at the next node, so that
/// several are reported at once.
Result<std::vector<ScriptNode>> parse_script(std::string_view text, const std::string& file);

/// The same as one node without a type that holds the file's nodes and its last comments.
Result<ScriptNode> parse_script_file(std::string_view text, const std::string& file);

}  // namespace parvis::scene
