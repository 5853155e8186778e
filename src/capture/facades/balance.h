// Exposure and colour balanced over all photographs of a place, and what hides the model in single
// photographs found by colour.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "capture/facades/prepared_photo.h"

namespace parvis::facades {

/// A scale and an offset per channel: value in sRGB (0..1) of the balanced photograph = scale * value +
/// offset.
struct Balance {
  std::array<double, 3> scale{1, 1, 1}, offset{0, 0, 0};
};

/// Balances that bring the photographs to a common colour where they see the same surface: least squares over
/// points of the model on a grid of every `step`-th pixel, alternating between the common colour (weighted
/// mean over the photographs) and each photograph's balance, with outliers (other than the balance explains)
/// down-weighted. The mean balance is the identity.
std::vector<Balance> balances(std::span<const PreparedPhoto> photos, int step = 8);
/// Applies the balance to the colours of the photograph, in sRGB, in place.
void apply(const Balance& balance, PreparedPhoto& photo);

/// Sets every photograph's trust by comparing it with all others through the model: 0 where its colour,
/// averaged over 5x5 pixels, is far from the median of all, 1 where it is near, where fewer than three
/// others see the point, or where a block of 2x2 pixels alone is far from it.
void find_occluders(std::span<PreparedPhoto> photos);

}  // namespace parvis::facades
