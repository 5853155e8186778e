// Departures from Deussen et al. 2002: leaves keep their own size, place and direction as points, so that the
// area is kept leaf by leaf; twigs are left out by priority sampling (Duffield, Lund and Thorup 2007) in
// place of a fixed order; coarse leaves stand between geometry and points.
#include "life/vegetation/plant_levels.h"

#include <algorithm>
#include <cmath>

namespace parvis::vegetation {
namespace {

// Lengths of a leaf in the picture between which leaves change their form.
constexpr float full_from_px = 16.0f, full_to_px = 24.0f;
constexpr float simple_from_px = 5.0f, simple_to_px = 8.0f;
constexpr float point_area_px = 4.5f;  // mean of a point
constexpr float fading = 0.15f;        // of what is shown

float share_between(float value, float from, float to) {
  return std::clamp((value - from) / (to - from), 0.0f, 1.0f);
}

}  // namespace

LeafShares leaf_shares(const PlantShape& shape, float pixels_per_metre) {
  const float leaf_px = std::min(shape.mean_leaf_m * pixels_per_metre, 1e6f);
  LeafShares shares;
  shares.full = share_between(leaf_px, full_from_px, full_to_px);
  shares.simple = share_between(leaf_px, simple_from_px, simple_to_px);
  // Leaves of all directions show half of their area in the mean.
  const float scale = std::min(pixels_per_metre, 1e6f);
  shares.shown = std::min(0.5f * shape.mean_leaf_area_m2 * scale * scale / point_area_px, 1.0f);
  shares.shown = std::max(shares.shown, shares.simple);
  return shares;
}

float fading_share(float shown) { return std::min(fading * shown, 1.0f - shown); }

float area_growth(float shown) { return shown > 0.0f ? 1.0f / (shown - 0.5f * fading_share(shown)) : 1.0f; }

WoodShares wood_shares(const PlantShape& shape, float pixels_per_metre) {
  const float min_radius_m = 0.5f * line_px / pixels_per_metre;
  const auto piece =
      std::ranges::lower_bound(shape.pieces, min_radius_m, std::greater<>(), &WoodPiece::radius_m);
  const auto twig =
      std::ranges::upper_bound(shape.twigs, pixels_per_metre / line_px, {}, &Twig::min_pixels_per_metre);
  WoodShares shares;
  shares.pieces = std::uint32_t(piece - shape.pieces.begin());
  shares.twigs = shares.pieces == shape.pieces.size() ? 0 : std::uint32_t(twig - shape.twigs.begin());
  return shares;
}

std::uint32_t cluster_end(const PlantShape& shape, const LeafCluster& cluster, float share) {
  const auto first = shape.clustered.begin() + std::ptrdiff_t(cluster.first);
  const auto rank = std::uint32_t(std::ceil(share * float(shape.leaves.size())));
  return std::uint32_t(std::lower_bound(first, first + cluster.count, rank) - shape.clustered.begin());
}

}  // namespace parvis::vegetation
