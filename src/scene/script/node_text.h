// Nodes of a scene as script: what is read back as the same nodes.
#pragma once

#include <string>

#include "scene/script/node.h"
#include "scene/script/script_syntax.h"

namespace parvis::scene {

/// The node with all that stands in it, as a script writes it; files that it includes are in place.
ScriptNode written_node(const Node& node);

/// The script of these nodes.
std::string script_of(const Nodes& nodes);

}  // namespace parvis::scene
