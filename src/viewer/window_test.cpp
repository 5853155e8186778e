#include "viewer/window.h"

#include <gtest/gtest.h>

namespace parvis::viewer {
namespace {

constexpr bool on_software = true, on_gpu = false;

TEST(Window, HoldsARateByItself) {
  EXPECT_EQ(rate_of({}, on_software), 15.0);
  EXPECT_EQ(rate_of({}, on_gpu), 60.0);
}

TEST(Window, HoldsTheRateThatIsAskedFor) {
  WindowOptions options;
  options.frames_per_second = 25.0;
  EXPECT_EQ(rate_of(options, on_gpu), 25.0);
  options.frames_per_second = 0.0;
  EXPECT_EQ(rate_of(options, on_software), 0.0);
}

/// Pictures of a window that closes after some frames can be repeated; a bench asks for the rate all the
/// same.
TEST(Window, HoldsNoRateWhereItCloses) {
  WindowOptions options;
  options.max_frames = 3;
  EXPECT_EQ(rate_of(options, on_software), 0.0);
  options.always_holds_rate = true;
  EXPECT_EQ(rate_of(options, on_software), 15.0);
  EXPECT_EQ(rate_of(options, on_gpu), 60.0);
}

TEST(Window, BeginsAtOnceUnlessItsPicturesAreToBeRepeated) {
  WindowOptions options;
  EXPECT_TRUE(begins_at_once(options));
  options.max_frames = 3;
  EXPECT_FALSE(begins_at_once(options));
  options.always_holds_rate = true;
  EXPECT_TRUE(begins_at_once(options));
}

}  // namespace
}  // namespace parvis::viewer
