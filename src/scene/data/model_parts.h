// Parts of a model, chosen by name.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "scene/data/model.h"

namespace parvis::scene {

/// The parts whose object, node or material has a name that matches the pattern `target`
/// (scene/data/name_pattern.h).
std::vector<std::size_t> matching_parts(const Model& model, std::string_view target);

/// The first ten of some names, for messages: "post 1", "post 2", ...; none: "none" without quotes.
std::string listed(const std::set<std::string>& names);

/// The names of a model's parts, for messages about targets that match none: "WallSurface", "roof tiles"; the
/// first ten.
std::string part_names(const Model& model);

}  // namespace parvis::scene
