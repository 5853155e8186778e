// Trees of known shape to photograph: an orange tree, an oak, a pine and a sparse winter tree, grown by the
// rules of the house's procedural trees (city/tree_skeleton.h).
#pragma once

#include <array>
#include <string_view>

#include "base/result.h"
#include "scene/model.h"

namespace parvis::trees {

inline constexpr std::array sample_tree_names{std::string_view("orange"), std::string_view("oak"),
                                              std::string_view("pine"), std::string_view("winter")};

/// The foot is at the origin, z up, metres. Parts: "wood", "foliage" and "fruit", where the kind has them.
/// The same seed gives the same tree. Errors: a name that is none of sample_tree_names.
Result<scene::Model> make_sample_tree(std::string_view name, std::uint64_t seed);

/// What parvis tree measure is judged by, from the model's triangles.
struct TreeTruth {
  float height_m = 0.0f;
  float crown_base_m =
      0.0f;  ///< height of the lowest foliage (winter: of the lowest limb's fork), 2nd percentile
  float crown_width_m = 0.0f;  ///< mean of the extents along 36 horizontal directions
  float crown_volume_m3 =
      0.0f;                   ///< of the voxels of 0.25 m, closed along each axis, that hold foliage or twigs
  float leaf_area_m2 = 0.0f;  ///< one side, holes of the leaf textures left out
  float trunk_diameter_m = 0.0f;  ///< at 1.3 m, or at a fifth of smaller trees' height
};

}  // namespace parvis::trees
