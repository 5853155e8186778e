// Cast shadows that moved with the sun between photographs, flattened: each photograph gets the light on a
// surface that most photographs have seen on it.
#pragma once

#include <span>
#include <vector>

#include "capture/facades/prepared_photo.h"

namespace parvis::facades {

/// Pictures, one per photograph, of the factor by which linear colours are to be multiplied, 1 where nothing
/// moved. `photos` are balanced. A shadow is where a photograph is darker or brighter than the median of the
/// three or more that see the point, by one factor for all channels, over more than a few pixels; its edge is
/// that of the photograph's own picture (guided filter, He, Sun and Tang 2013, on a coarse grid as in He and
/// Sun 2015).
std::vector<ImageF> shadow_gains(std::span<const PreparedPhoto> photos);

/// Multiplies linear colours of 3 channels.
void apply_gains(const ImageF& gains, ImageF& colours);

}  // namespace parvis::facades
