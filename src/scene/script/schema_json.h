// The node types as JSON, for editors and panels: `parvis check --schema`.
#pragma once

#include <string>

#include "scene/script/node_registry.h"

namespace parvis::scene {

/// {"nodes":[{"type", "help", "stands_in", "is_unique", "example", "attributes":[...], "messages":[{"name",
/// "help", "arguments":[...]}]}]}; an attribute or argument has "name", "type", "help" and, where it has one,
/// "unit", "default", "minimum", "maximum", "choices", "source", "refers_to", "spellings".
std::string schema_json(const NodeRegistry& registry);

}  // namespace parvis::scene
