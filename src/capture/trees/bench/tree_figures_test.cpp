// The smallest captures that the bench measures: that its controls fail where they must.
#include <gtest/gtest.h>

#include <cmath>

#include "capture/trees/bench/reconstructed_tree.h"

namespace parvis::trees {
namespace {

TEST(TreeBench, ACaptureBecomesATree) {
  BenchCaptureSize size = bench_capture_size({true});
  size.capture.width = size.capture.height = 64, size.capture.samples_per_pixel = 4, size.held_out = 1;
  size.options.fine_epochs = 1;
  const Result<SampleCapture> capture = sample_capture("winter", 8, size);
  ASSERT_TRUE(capture) << to_string(capture.errors());
  EXPECT_EQ(capture->views.size(), 8u);
  const Result<ReconstructedTree> made = reconstructed_tree(*capture, size);
  ASSERT_TRUE(made) << to_string(made.errors());
  EXPECT_GT(made->levels->levels.front().grid.size(), 50u);
  EXPECT_GT(made->seconds(), 0.0);
  EXPECT_GT(made->megabytes, 0.0);
  EXPECT_FALSE(sample_capture("beech", 8, size)) << "no such tree";
}

TEST(TreeBench, AFigureThatIsNoNumberIsAnError) {
  int added = 0;
  const FigureSink sink{[&](const std::string&, double) { ++added; }, {}, {}};
  EXPECT_TRUE(sink.figure("psnr_db_22", 26.0));
  EXPECT_FALSE(sink.figure("psnr_db_22", std::nan("")));
  EXPECT_FALSE(sink.figure("psnr_db_22", 1.0 / 0.0));
  EXPECT_EQ(added, 1);
}

}  // namespace
}  // namespace parvis::trees
