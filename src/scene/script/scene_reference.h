// The reference of the scene language, from the schemas: docs/scene-reference.md.
#pragma once

#include <string>

#include "scene/script/node_registry.h"

namespace parvis::scene {

/// Markdown. A test holds the committed file to it; `parvis check --reference` prints it.
std::string scene_reference(const NodeRegistry& registry);

}  // namespace parvis::scene
