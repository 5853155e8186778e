#include "reflections/probes/probe_blend.h"

#include <gtest/gtest.h>

namespace parvis::probes {
namespace {

TEST(ProbeBlend, BothHaveHalfMidwayAndTheNearestHasAllAtItsPlace) {
  EXPECT_FLOAT_EQ(share_of_second(15, 15, 45.0f), 0.5f);
  EXPECT_FLOAT_EQ(share_of_second(15, 15, {}), 0.5f);
  EXPECT_FLOAT_EQ(share_of_second(0, 30, 30.0f), 0.0f);
  EXPECT_FLOAT_EQ(share_of_second(0, 30, {}), 0.0f);
}

TEST(ProbeBlend, FadesToNothingWhereTheThirdTakesItsPlace) {
  float before = share_of_second(10, 20, 30.0f);
  for (const float second_m : {22.0f, 25.0f, 28.0f, 29.9f}) {
    const float share = share_of_second(10, second_m, 30.0f);
    EXPECT_LT(share, before) << second_m;
    before = share;
  }
  EXPECT_LT(before, 0.01f);
}

TEST(ProbeBlend, IsAShareWhereProbesCoincide) {
  for (const float share :
       {share_of_second(0, 0, {}), share_of_second(0, 0, 0.0f), share_of_second(5, 5, 5.0f)}) {
    EXPECT_GE(share, 0.0f);
    EXPECT_LE(share, 0.5f);
  }
}

}  // namespace
}  // namespace parvis::probes
