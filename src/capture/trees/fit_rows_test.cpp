#include "capture/trees/fit_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "machines/test_processes.h"

namespace parvis::trees {
namespace {

/// A photograph in which no two pixels of a column are alike.
TreeView photograph(int width, int height) {
  TreeView view{"one", {}, Image8(width, height, 4)};
  view.camera.width = width, view.camera.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint8_t pixel[]{std::uint8_t(40 + 17 * y), std::uint8_t(5 * x), 90, std::uint8_t(200 + y)};
      std::ranges::copy(pixel, view.picture.at(x, y));
    }
  return view;
}

TEST(FitRows, ProcessesTogetherHoldEachRowOnce) {
  for (const int factor : {1, 2})
    for (const int count : {1, 2, 3}) {
      const TreeView view = photograph(6, 11);
      const FitRows whole = FitRows::of(view, factor, {});
      ASSERT_EQ(whole.rgba.height, whole.camera.height);
      std::vector<int> held(std::size_t(whole.rgba.height), 0);
      for (int rank = 0; rank < count; ++rank) {
        const FitRows own = FitRows::of(view, factor, machines::ThreadProcesses::alone(rank, count));
        EXPECT_LE(own.rgba.height, whole.rgba.height / count + 1) << "its share, no more";
        for (int i = 0; i < own.rgba.height; ++i) {
          ASSERT_LT(own.row(i), whole.rgba.height);
          ++held[std::size_t(own.row(i))];
          const float *found = own.rgba.at(0, i), *wanted = whole.rgba.at(0, own.row(i));
          EXPECT_TRUE(std::equal(found, found + 4 * own.rgba.width, wanted)) << rank << " " << i;
        }
      }
      EXPECT_EQ(held, std::vector<int>(held.size(), 1)) << factor << " " << count;
    }
}

TEST(FitRows, AreWeighedByAlphaInLinearLight) {
  TreeView view = photograph(2, 2);
  view.picture.pixels = {255, 0, 0, 255, 0, 255, 0, 0, 255, 0, 0, 255, 0, 255, 0, 0};
  const FitRows rows = FitRows::of(view, 2, {});
  ASSERT_EQ(rows.rgba.pixels.size(), 4u);
  EXPECT_NEAR(rows.rgba.pixels[0], 0.5f, 1e-6f);
  EXPECT_EQ(rows.rgba.pixels[1], 0.0f) << "what is transparent has no colour";
  EXPECT_NEAR(rows.rgba.pixels[3], 0.5f, 1e-6f);
}

TEST(FitRows, MoreProcessesThanRowsLeaveSomeWithoutAny) {
  EXPECT_EQ(FitRows::of(photograph(2, 2), 1, machines::ThreadProcesses::alone(2, 3)).rgba.height, 0);
}

}  // namespace
}  // namespace parvis::trees
