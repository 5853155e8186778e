#include "capture/trees/opacity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <span>

#include "capture/trees/test_volume.h"

namespace parvis::trees {
namespace {

constexpr int photo_side = 56;

/// Held-out error of a method on the ball of sparse cells, its grid found from the views alone.
struct Judged {
  std::vector<TreeView> views = TestVolume().ring(16, photo_side),
                        held_out = TestVolume().ring(4, photo_side, 0.17f);
  std::vector<Silhouette> masks = silhouettes(views);
  CellGrid grid = *hull_grid(views, masks, *hull_box(views, masks), {3, 3});

  double rmse(OpacityMethod method, int iterations, bool clamps = true) const {
    OpacityOptions options;
    options.method = method, options.iterations = iterations, options.clamps = clamps;
    return alpha_rmse(grid, estimate_opacity(grid, views, masks, options).extinction_per_m, held_out, 1);
  }
};

const Judged& sparse_ball() {
  static const Judged judged;
  return judged;
}

TEST(Opacity, MultiplicativePredictsHeldOutViewsBetterThanTheThesis) {
  const Judged& judged = sparse_ball();
  const double start =
      alpha_rmse(judged.grid, initial_extinction(judged.grid, judged.masks), judged.held_out, 1);
  const double thesis = judged.rmse(OpacityMethod::projection, 4);
  const double multiplicative = judged.rmse(OpacityMethod::multiplicative, 20);
  EXPECT_LT(thesis, start);
  EXPECT_LT(multiplicative,
            0.85 * thesis);  // 0.80 here; the 0.6 is for trees, which are smoother than this
  EXPECT_LT(judged.rmse(OpacityMethod::multiplicative, 20), judged.rmse(OpacityMethod::multiplicative, 2));
}

TEST(Opacity, TheThesisAsPrintedIsWorseThanClamped) {
  const Judged& judged = sparse_ball();
  EXPECT_GT(judged.rmse(OpacityMethod::projection, 4, false), judged.rmse(OpacityMethod::projection, 4));
}

TEST(Opacity, SirtFitsTheLogarithm) {
  const Judged& judged = sparse_ball();
  EXPECT_LT(judged.rmse(OpacityMethod::sirt, 10), judged.rmse(OpacityMethod::sirt, 1));
}

TEST(Opacity, OneCellOfKnownExtinctionIsFoundAgain) {
  const Bounds box{{-0.5f, -0.5f, 0.5f}, {0.5f, 0.5f, 1.5f}};
  TestVolume volume(1, 2.0f, 1.5f);
  volume.grid = CellGrid(box, 3, 1, {{0, 0, 0}}), volume.extinction_per_m = {1.5f};
  const std::vector<TreeView> views = volume.ring(6, photo_side);
  const std::vector<Silhouette> masks = silhouettes(views);
  for (const OpacityMethod method : {OpacityMethod::sirt, OpacityMethod::multiplicative}) {
    OpacityOptions options;
    options.method = method, options.iterations = 30, options.picture_factor = 1;
    EXPECT_NEAR(estimate_opacity(volume.grid, views, masks, options).extinction_per_m[0], 1.5f, 0.02f);
  }
}

TEST(Opacity, ChangesShrinkFromIterationToIteration) {
  const Judged& judged = sparse_ball();
  const Opacities found = estimate_opacity(judged.grid, judged.views, judged.masks, {});
  ASSERT_EQ(found.mean_change.size(), 20u);
  EXPECT_LT(found.mean_change.back(), 0.25 * found.mean_change.front());
}

TEST(Opacity, TheCutoffEmptiesCells) {
  const Judged& judged = sparse_ball();
  OpacityOptions options;
  options.cutoff = 0.94f;
  const Opacities cut = estimate_opacity(judged.grid, judged.views, judged.masks, options);
  const float chord_m = mean_chord_m(judged.grid.cell_size_m());
  std::size_t empty = 0;
  for (const float tau : cut.extinction_per_m) {
    EXPECT_TRUE(tau == 0.0f || std::exp(-tau * chord_m) <= 0.94f);
    empty += tau == 0.0f;
  }
  EXPECT_GT(empty, judged.grid.size() / 10);
  EXPECT_LT(empty, judged.grid.size());
}

TEST(Opacity, TheAutomaticCutoffIsOneOfTheThesiss) {
  const Judged& judged = sparse_ball();
  const float cutoff = cutoff_by_held_out_error(judged.grid, judged.views, {});
  EXPECT_GE(cutoff, 0.85f);
  EXPECT_LE(cutoff, 1.0f);
}

}  // namespace
}  // namespace parvis::trees
