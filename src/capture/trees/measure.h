// Measurements of a captured tree for those who tend it: from the volume's cells, and from models of known
// shape to judge them by.
#pragma once

#include <vector>

#include "capture/trees/tree_volume.h"
#include "scene/data/model.h"

namespace parvis::trees {

/// Lengths in metres; heights count from the foot.
struct TreeMeasures {
  float height_m = 0.0f;
  float crown_base_m = 0.0f;       ///< where the tree becomes wider than 2.5 times its trunk
  float crown_width_m = 0.0f;      ///< mean over 36 horizontal directions, above the crown's base
  float crown_volume_m3 = 0.0f;    ///< convex hulls of slices of 1/40 of the height: tree_outline.h
  float projected_area_m2 = 0.0f;  ///< opaque area seen from the side, mean of two horizontal directions
  float trunk_diameter_m = 0.0f;   ///< the narrowest slice below a fifth of the height, the foot left out
  std::vector<float> leaf_area_density_per_m;  ///< m2 of leaves (one side) per m3 of crown, per tenth of the
                                               ///< height; 0 below the crown's base, where the trunk is
};

/// Measures of a volume: the tree is where its cells stop at least `min_alpha` of the light that passes them
/// together, horizontally: two or three steps of a matte of 8 bits. Leaf area density takes leaves of all
/// directions alike: twice the mean extinction (Ross 1981). Opaque cells hide how many leaves are behind each
/// other, so that dense crowns come out too low.
TreeMeasures measured(const TreeVolume& volume, float min_alpha = 0.01f);

/// Measures of a model's triangles as the path tracer photographs them: where the alpha of a cutout material
/// is below half nothing is there. Without projected area and leaf area density.
TreeMeasures measured(const scene::Model& model);

}  // namespace parvis::trees
