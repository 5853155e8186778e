#include "graphics/gl/pass_times.h"

#include <gtest/gtest.h>

#include "graphics/gl/test_context.h"

namespace parvis::gl {
namespace {

class PassTimesTest : public ContextTest {};

/// Draws nothing, in passes of these names.
void play(PassTimes& times, std::initializer_list<const char*> passes) {
  times.begin_frame();
  for (const char* pass : passes) times.end_pass(pass);
  glFinish();
}

TEST_F(PassTimesTest, ComeAFrameLaterInTheOrderOfThePasses) {
  PassTimes times;
  play(times, {"shadows", "picture"});
  EXPECT_TRUE(times.latest().empty()) << "nobody has looked yet";
  times.begin_frame();
  ASSERT_EQ(times.latest().size(), 2u);
  EXPECT_EQ(times.latest()[0].name, "shadows");
  EXPECT_EQ(times.latest()[1].name, "picture");
  for (const PassTime& pass : times.latest()) {
    EXPECT_GE(pass.seconds, 0.0);
    EXPECT_LT(pass.seconds, 10.0);
  }
}

TEST_F(PassTimesTest, AreThoseOfTheLatestFrameWhoseNumberOfPassesMayChange) {
  PassTimes times;
  for (int frame = 0; frame < 12; ++frame) play(times, {"one", "two", "three"});
  play(times, {"alone"});
  times.begin_frame();
  ASSERT_EQ(times.latest().size(), 1u);
  EXPECT_EQ(times.latest()[0].name, "alone");
}

TEST_F(PassTimesTest, OfAFrameWithoutPassesTellNothing) {
  PassTimes times;
  play(times, {"picture"});
  play(times, {});
  times.begin_frame();
  ASSERT_EQ(times.latest().size(), 1u) << "the frame before";
}

}  // namespace
}  // namespace parvis::gl
