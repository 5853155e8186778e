// Parts of a model, chosen by name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/data/model.h"

namespace parvis::scene {

/// The parts whose object, node or material has a name that matches the pattern `target`
/// (scene/data/name_pattern.h).
std::vector<std::size_t> matching_parts(const Model& model, std::string_view target);

/// The names of a model's parts and materials, each once, for messages about targets that match none
/// (base/known_names.h): "WallSurface", "roof tiles".
std::vector<std::string> part_names(const Model& model);

}  // namespace parvis::scene
