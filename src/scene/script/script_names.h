// Name resolution for a scene script, after all its files are read: references, events and scenario
// overrides. A node may refer to a later one.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/files.h"
#include "scene/script/node.h"
#include "scene/script/script_syntax.h"

namespace parvis::scene {

/// Location of a node as a map key: file, line, column.
using NodePlace = std::pair<std::string, std::pair<int, int>>;
/// The key of a location.
inline NodePlace place_of(const FileLocation& where) { return {where.file, {where.line, where.column}}; }

/// Names collected while the script's files were read.
struct ScriptNames {
  std::map<std::string, FileLocation> given;  ///< names, of nodes and of what they make
  /// Attributes that only another node's type can interpret, by the location of the node that gives them.
  std::map<NodePlace, std::vector<ScriptAttribute>> unexplained;
};

/// Resolves every name that the nodes use, and parses overrides by the schema of the node that they override.
/// Reports each mistake to `fail`. Names may be those of `others`, too: of nodes that have been resolved.
void resolve_names(Nodes& nodes, const ScriptNames& names, const Roots& roots,
                   const std::function<void(Error)>& fail, const Nodes& others = {});

}  // namespace parvis::scene
