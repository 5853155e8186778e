#include "bench/light/frame_costs.h"

#include <limits>
#include <utility>

#include "bench/report.h"

namespace parvis::bench {
namespace {

/// Of frames in turn: what slows both for a while leaves it as it is.
double median_difference(const std::vector<FrameCost>& more, const std::vector<FrameCost>& less, Cost cost) {
  std::vector<double> differences;
  differences.reserve(more.size());
  for (std::size_t i = 0; i < more.size(); ++i) differences.push_back(more[i].*cost - less[i].*cost);
  return median(std::move(differences)).value;
}

}  // namespace

double median_of(const std::vector<FrameCost>& frames, Cost cost) {
  std::vector<double> all;
  all.reserve(frames.size());
  for (const FrameCost& frame : frames) all.push_back(frame.*cost);
  return median(std::move(all)).value;
}

double FrameCosts::depth_pass(Cost cost) const { return median_difference(maps, kept, cost); }

double FrameCosts::rays_over_depth_pass(Cost cost) const {
  const double beyond_maps = median_difference(rays, maps, cost), drawing = depth_pass(cost);
  if (!(beyond_maps > 0.0 && drawing > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  return beyond_maps / drawing;
}

double FrameCosts::walked_over_kept(Cost cost) const {
  const double by_maps = median_of(kept, cost);
  return by_maps > 0.0 ? median_of(walked, cost) / by_maps : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace parvis::bench
