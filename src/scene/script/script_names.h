// Names in a scene script, once all its files are read: what nodes refer to, what events send, what scenarios
// override. A node may refer to one that comes later.
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

/// A node's place, to be looked up by: file, line, column.
using NodePlace = std::pair<std::string, std::pair<int, int>>;
inline NodePlace place_of(const FileLocation& where) { return {where.file, {where.line, where.column}}; }

/// What was noted while the files were read.
struct ScriptNames {
  std::map<std::string, FileLocation> given;  ///< names, of nodes and of what they make
  /// Attributes that another node's type must explain, by the place of the node that gives them.
  std::map<NodePlace, std::vector<ScriptAttribute>> unexplained;
};

/// Checks every name that the nodes use, and reads their overrides by the schema of the node they override.
/// Reports each mistake to `fail`.
void resolve_names(std::vector<Node>& nodes, const ScriptNames& names, const Roots& roots,
                   const std::function<void(Error)>& fail);

}  // namespace parvis::scene
