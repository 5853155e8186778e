// The smallest captures that the bench measures: that its controls fail where they must.
#include <gtest/gtest.h>

#include <cmath>

#include "capture/trees/bench/reconstructed_tree.h"
#include "capture/trees/sample_trees.h"
#include "graphics/gl/test_context.h"

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

class TreeBenchMesh : public gl::ContextTest {};

TEST_F(TreeBenchMesh, TheMeshThatWasPhotographedShowsItsPhotographs) {
  const Result<scene::Model> model = make_sample_tree("winter", 1);
  ASSERT_TRUE(model) << to_string(model.errors());
  BenchCaptureSize size = bench_capture_size({true});
  size.truth_samples_per_pixel = 16;
  const std::vector<Camera> cameras = held_out_cameras(scene::bounds(*model), 2, 5);
  const std::vector<TreeView> views =
      photograph_tree(capture_scene(*model, {}), cameras, "winter", truth_options(size));
  const Result<ViewErrors> mesh = errors_of_mesh(*model, views);
  ASSERT_TRUE(mesh) << to_string(mesh.errors());
  // Measured 28.0 dB and 0.066: twigs are thinner than pixels, of which the house takes four samples.
  EXPECT_GT(mesh->psnr_db, 26.0);
  EXPECT_LT(mesh->alpha_rmse, 0.08);
  // The control: each photograph with the other's camera.
  std::vector<TreeView> wrong = views;
  std::swap(wrong[0].camera, wrong[1].camera);
  const Result<ViewErrors> other = errors_of_mesh(*model, wrong);
  ASSERT_TRUE(other) << to_string(other.errors());
  EXPECT_LT(other->psnr_db, mesh->psnr_db - 6.0);
  EXPECT_GT(other->alpha_rmse, 2.0 * mesh->alpha_rmse);
  EXPECT_FALSE(errors_of_mesh(*model, {})) << "no views";
}

TEST(TreeBench, AFigureThatIsNoNumberIsAnError) {
  int added = 0;
  const FigureSink sink{[&](const std::string&, double) { ++added; }, {}, {}};
  EXPECT_TRUE(sink.figure("psnr_db_22", 26.0));
  EXPECT_FALSE(sink.figure("psnr_db_22", std::nan("")));
  EXPECT_FALSE(sink.figure("psnr_db_22", 1.0 / 0.0));
  EXPECT_EQ(added, 1);
}

TEST(TreeBench, AControlThatReachesTheTargetIsSaid) {
  int added = 0, rows = 0;
  const FigureSink sink{
      [&](const std::string&, double) { ++added; }, [&](const std::string&) { ++rows; }, {}};
  const Target min_psnr_db{26.0, false}, max_megabytes{6.6, true};
  EXPECT_TRUE(sink.control("psnr_db_22_naive", 20.0, min_psnr_db));
  EXPECT_TRUE(sink.control("tree_mb_uncompressed", 13.5, max_megabytes));
  EXPECT_EQ(rows, 0) << "both miss it, as they must";
  EXPECT_TRUE(sink.control("psnr_db_22_naive", 26.0, min_psnr_db));
  EXPECT_TRUE(sink.control("tree_mb_uncompressed", 6.6, max_megabytes));
  EXPECT_EQ(rows, 2);
  EXPECT_EQ(added, 4);
  EXPECT_FALSE(sink.control("psnr_db_22_naive", std::nan(""), min_psnr_db));
}

TEST(TreeBench, TwoProcessesThatDoNotKnowOfEachOtherAreNoTwo) {
  const std::string alone = "out/oak.volume: 3455 cells, 0.12 MB, 1 process\n";
  EXPECT_TRUE(says_processes(alone, 1));
  EXPECT_FALSE(says_processes(alone + alone, 2)) << "each did all of the work";
  EXPECT_TRUE(says_processes("out/oak.volume: 3455 cells, 0.12 MB, 2 processes\n", 2));
  EXPECT_FALSE(says_processes("out/oak.volume: 3455 cells, 0.12 MB, 12 processes\n", 2));
}

}  // namespace
}  // namespace parvis::trees
