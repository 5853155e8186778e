// Trees of a map or city model, as places where plants can stand.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "scene/data/model.h"

namespace parvis::kerbside {

/// A tree of a model.
struct MapTree {
  glm::vec3 foot{0.0f};  ///< in the model's frame
  float height_m = 0.0f;
  std::string name;  ///< of its object, with the species where the map knows it
};

/// Trees of all models that one pattern names, at most.
inline constexpr std::size_t max_map_trees = 50'000;
/// Pieces of a model of which trees are made, and pairs of them that stand close together, at most.
inline constexpr std::size_t max_tree_pieces = 4 * max_map_trees, max_tree_pairs = 100'000'000;

/// Takes the trees out of the parts that match the pattern `target`. Triangles that share corners are one
/// piece. Pieces of one name are one tree where they stand about one axis, as a trunk and its crown or
/// crossed pictures do, or where one hangs above a trunk: it belongs to the nearest below it. Fails
/// where there are more pieces or pairs than trees are made of; the model has lost its trees then, too.
Result<std::vector<MapTree>> take_trees(scene::Model& model, std::string_view target);

/// The kind of plant that is nearest to a tree of this name ("SolitaryVegetationObject Quercus robur"), or
/// `usual` where the name holds no genus of a kind that can be grown.
std::string_view plant_kind_of(std::string_view name, std::string_view usual);

}  // namespace parvis::kerbside
