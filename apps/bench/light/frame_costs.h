// What the beginnings of frames cost by rays and by shadow maps, and what of it the rays themselves cost.
#pragma once

#include <vector>

namespace parvis::bench {

/// Of one frame.
struct FrameCost {
  double ms = 0.0, cpu_ms = 0.0;  ///< by the clock, and of all cores
};
/// Either of them.
using Cost = double FrameCost::*;

/// Zero of none.
double median_of(const std::vector<FrameCost>& frames, Cost cost);

/// Frames of one size in turn, each under a sun of its own: by rays, by the default's maps, by the same maps
/// where they are kept, because sun and view are those of the frame before, and by rays a step on under the
/// same sun.
struct FrameCosts {
  std::vector<FrameCost> rays, maps, kept, walked;

  /// What the drawing of the maps costs.
  double depth_pass(Cost cost) const;
  /// What the rays cost over that. Method rays draws the default's maps, too, whose cost is not that of its
  /// rays. No number where either is nothing: the clock has then shown noise.
  double rays_over_depth_pass(Cost cost) const;
  /// Of a walk under a sun that stays: all that begins a frame by rays, over the same by maps, which are
  /// kept.
  double walked_over_kept(Cost cost) const;
};

}  // namespace parvis::bench
