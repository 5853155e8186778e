// The bark of a captured trunk without the light of its photographs, so that the scene's sun and sky light
// it.
#pragma once

#include "capture/trees/billboard_tree.h"

namespace parvis::trees {

/// The bark's albedo, as the picture `shape.bark`: the photographs' radiance over what the sun and the sky of
/// the photographs (tree.light) bring to a matt surface there through the tree's crown. As of leaves, the
/// mean brightness is that of `mean_albedo`.
Image8 bark_albedo(const TrunkShape& shape, const BillboardTree& tree);

}  // namespace parvis::trees
