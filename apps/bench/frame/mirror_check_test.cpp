#include "bench/frame/mirror_check.h"

#include <gtest/gtest.h>

#include "graphics/gl/context.h"
#include "house/rooms.h"

namespace parvis::bench {
namespace {

/// The GPU's cube maps against the ray tracer; exchanged faces show that the check can fail.
TEST(Mirrors, CubeMapsAgreeWithTheRayTracer) {
  const Result<gl::Context> context = gl::Context::create_headless();
  ASSERT_TRUE(context) << to_string(context.errors());
  const Result<MirrorFlips> flips = mirror_flips(house::all_rooms());
  ASSERT_TRUE(flips) << to_string(flips.errors());
  EXPECT_LT(flips->ball, 0.02);
  EXPECT_LT(flips->box, 0.02);
  EXPECT_GT(flips->ball_faces_swapped, 0.2);
}

}  // namespace
}  // namespace parvis::bench
