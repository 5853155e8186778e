// The rays' own share of what frames cost.
#include "bench/light/frame_costs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace parvis::bench {
namespace {

/// Rays take 12 ms beyond maps of which 20 ms are their drawing; one turn of three was slowed by 500 ms.
FrameCosts some_costs() {
  FrameCosts costs;
  for (const double slow : {0.0, 500.0, 0.0}) {
    costs.rays.push_back({slow + 42.0, 84.0});
    costs.maps.push_back({slow + 30.0, 60.0});
    costs.kept.push_back({slow + 10.0, 20.0});
    costs.walked.push_back({slow + 25.0, 40.0});
  }
  return costs;
}

TEST(FrameCosts, CountTheRaysWithoutTheMapsThatTheirMethodDraws) {
  const FrameCosts costs = some_costs();
  EXPECT_DOUBLE_EQ(costs.depth_pass(&FrameCost::ms), 20.0);
  EXPECT_DOUBLE_EQ(costs.rays_over_depth_pass(&FrameCost::ms), 0.6);
  EXPECT_DOUBLE_EQ(costs.rays_over_depth_pass(&FrameCost::cpu_ms), 0.6);
  EXPECT_DOUBLE_EQ(median_of(costs.rays, &FrameCost::ms), 42.0);
  EXPECT_DOUBLE_EQ(costs.walked_over_kept(&FrameCost::ms), 2.5);
  EXPECT_DOUBLE_EQ(costs.walked_over_kept(&FrameCost::cpu_ms), 2.0);
  EXPECT_TRUE(std::isnan(FrameCosts().walked_over_kept(&FrameCost::ms)));
}

TEST(FrameCosts, AreNoNumberWhereTheClockShowsNoise) {
  FrameCosts costs = some_costs();
  costs.rays = costs.kept;
  EXPECT_TRUE(std::isnan(costs.rays_over_depth_pass(&FrameCost::ms))) << "rays that cost less than nothing";
  costs = some_costs();
  costs.kept = costs.maps;
  EXPECT_TRUE(std::isnan(costs.rays_over_depth_pass(&FrameCost::ms))) << "maps that cost nothing";
  EXPECT_TRUE(std::isnan(FrameCosts().rays_over_depth_pass(&FrameCost::ms)));
}

}  // namespace
}  // namespace parvis::bench
