#include "viewer/frame_statistics.h"

#include <gtest/gtest.h>

namespace parvis::viewer {
namespace {

TEST(FrameStatistics, TellOfTheLastFrames) {
  FrameStatistics statistics;
  EXPECT_EQ(statistics.mean_ms(), 0.0);
  EXPECT_TRUE(statistics.frames_ms().empty());
  statistics.add(0.010, {});
  statistics.add(0.030, {});
  EXPECT_NEAR(statistics.mean_ms(), 20.0, 1e-4);
  EXPECT_NEAR(statistics.worst_ms(), 30.0, 1e-4);
  for (std::size_t i = 0; i < FrameStatistics::frames_kept; ++i) statistics.add(0.005, {});
  EXPECT_NEAR(statistics.worst_ms(), 5.0, 1e-4) << "older ones are forgotten";
  statistics.add(0.007, {});
  EXPECT_EQ(statistics.frames_ms().size(), FrameStatistics::frames_kept);
  EXPECT_FLOAT_EQ(statistics.frames_ms().back(), 7.0f) << "the newest last";
}

TEST(FrameStatistics, SmoothPasses) {
  FrameStatistics statistics;
  const std::vector<gl::PassTime> slow{{"shadows", 0.004}, {"picture", 0.010}};
  const std::vector<gl::PassTime> fast{{"shadows", 0.002}, {"picture", 0.010}};
  statistics.add(0.01, slow);
  statistics.add(0.01, fast);
  ASSERT_EQ(statistics.passes().size(), 2u);
  EXPECT_GT(statistics.passes()[0].seconds, 0.003);
  EXPECT_LT(statistics.passes()[0].seconds, 0.004);
  EXPECT_NEAR(statistics.passes()[1].seconds, 0.010, 1e-12);
  for (int i = 0; i < 100; ++i) statistics.add(0.01, fast);
  EXPECT_NEAR(statistics.passes()[0].seconds, 0.002, 1e-5);
  const std::vector<gl::PassTime> other{{"panel", 0.001}};
  statistics.add(0.01, other);
  ASSERT_EQ(statistics.passes().size(), 1u) << "other passes start over";
  EXPECT_EQ(statistics.passes()[0].seconds, 0.001);
}

TEST(FrameStatistics, WhatTheProgramDoesIsApartFromThePasses) {
  FrameStatistics statistics;
  const std::vector<gl::PassTime> pass{{"picture", 0.020}}, people{{"people", 0.004}};
  statistics.add(0.03, pass);
  statistics.add_on_processor(people);
  ASSERT_EQ(statistics.passes().size(), 1u);
  ASSERT_EQ(statistics.passes_on_processor().size(), 1u);
  EXPECT_EQ(statistics.passes_on_processor()[0].seconds, 0.004);
}

TEST(FrameStatistics, RatesBelowOneAreShownAsSuch) {
  EXPECT_EQ(frame_rate(0.0), "");
  EXPECT_EQ(frame_rate(41.7), "24 per second");
  EXPECT_EQ(frame_rate(400.0), "2.5 per second");
  EXPECT_EQ(frame_rate(3400.0), "one in 3.4 s");
}

}  // namespace
}  // namespace parvis::viewer
