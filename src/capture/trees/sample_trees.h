// Trees of known shape to photograph: an orange tree, an oak, a pine and a sparse winter tree, grown by the
// rules of Parvis's procedural trees (city/tree_skeleton.h).
#pragma once

#include <array>
#include <string_view>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::trees {

inline constexpr std::array sample_tree_names{std::string_view("orange"), std::string_view("oak"),
                                              std::string_view("pine"), std::string_view("winter")};

/// The foot is at the origin, z up, metres. Parts: "wood", "foliage" and "fruit", where the kind has them.
/// The same seed gives the same tree. Errors: a name that is none of sample_tree_names.
Result<scene::Model> make_sample_tree(std::string_view name, std::uint64_t seed);

}  // namespace parvis::trees
