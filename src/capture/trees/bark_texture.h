// The picture of a trunk's bark, from photographs.
#pragma once

#include <cmath>
#include <span>

#include "base/image.h"
#include "capture/trees/tree_view.h"
#include "capture/trees/trunk_shape.h"

namespace parvis::trees {

/// How green a colour is, in linear light: the logarithm of green over red, by which leaves and wood differ.
inline float log_ratio(glm::vec3 colour) { return std::log((colour.y + 0.004f) / (colour.x + 0.004f)); }

/// The bark, sRGB, u round the trunk from the east, v down from its top: each texel shows what the cameras
/// see that look at it most directly, where that is neither background nor greener than `leaf_threshold`
/// (log_ratio). Finer than their pixels, the contrast that they show is repeated at a smaller scale.
Image8 bark_texture(const Trunk& trunk, std::span<const TreeView> views, float leaf_threshold);

}  // namespace parvis::trees
