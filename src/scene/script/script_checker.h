// From files of script to checked nodes: reads a script and those it includes, and holds every node to its
// schema.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/files.h"
#include "base/result.h"
#include "scene/script/node.h"
#include "scene/script/node_registry.h"

namespace parvis::scene {

/// Limits on a script with all that it includes: a few short files that include each other twice would else
/// be endless.
inline constexpr std::size_t max_scene_nodes = 500'000;
inline constexpr std::size_t max_included_files = 10'000;  ///< a file that is included twice counts twice
inline constexpr std::size_t max_include_depth = 16;
inline constexpr std::size_t max_included_bytes = 512u << 20;  ///< of all files, read as often as included

/// The top-level nodes of `script`. Every error of every file is reported: syntax, unknown types and
/// attributes, values, files that are missing or lie outside `roots`, repeated names, references to nothing,
/// cyclic includes. Files are relative to the script that names them, see find_named_file.
Result<Nodes> check_script(const std::filesystem::path& script, const NodeRegistry& registry,
                           const Roots& roots);

/// The same for a piece of script that is to stand in a node of the type `parent` (`top_level`: in none) of a
/// scene whose nodes are `others`: its names are new, and it may refer to theirs. `file` stands in errors.
Result<Nodes> check_piece(std::string_view text, const std::string& file, const std::string& parent,
                          const Nodes& others, const NodeRegistry& registry, const Roots& roots);

}  // namespace parvis::scene
