// The kinds of plants that can be grown, by their numbers.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "life/vegetation/leaf_template.h"
#include "synthesis/tree_skeleton.h"

namespace parvis::vegetation {

/// How a plant of some kind fills space.
enum class Habit : std::uint8_t {
  tree,   ///< a trunk with limbs, branches and twigs
  hedge,  ///< stems in a row and a clipped crown: a box
  sward   ///< blades of grass over a square
};

/// Parameters of a kind. Colours are linear.
struct PlantKind {
  std::string_view name;  ///< as scripts call it
  Habit habit;
  float height_m;  ///< as usual
  float min_height_m, max_height_m;
  float trunk_share;                           ///< radius of the trunk at its foot, of the height
  std::vector<synthesis::BranchOrder> orders;  ///< of trees
  bool grows_in_whorls = false;  ///< of trees: as grow_in_whorls does, else they fork (grow_tree)
  LeafForm leaf;
  float leaf_m;  ///< mean length
  /// Number of leaves: of a tree at the usual height; of others per square metre of hedge's surface, of
  /// ground.
  float leaves;
  glm::vec3 dark, light;          ///< leaves lie between the two
  float translucency, roughness;  ///< of the leaves
  float veins;                    ///< side veins per leaf length; 0: none
  glm::vec3 bark;
};

/// Every kind.
const std::vector<PlantKind>& plant_kinds();
/// The kind of that name, or null.
const PlantKind* find_kind(std::string_view name);

}  // namespace parvis::vegetation
