// The formatter: a script's tree as text, in one style, with its comments.
#pragma once

#include <string>

#include "scene/script/script_syntax.h"

namespace parvis::scene {

/// Lines of this many bytes are broken between attributes.
inline constexpr std::size_t longest_line = 100;

/// The text of what parse_script_file gave: two spaces for each level, a node to a line, `name=value` parted
/// by ", ", blank lines kept one at a time, comments where they stood. Reading it gives the same tree, and
/// formatting that the same text.
std::string format_script(const ScriptNode& file);

}  // namespace parvis::scene
