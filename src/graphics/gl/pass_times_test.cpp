#include "graphics/gl/pass_times.h"

#include <gtest/gtest.h>

#include "graphics/gl/objects.h"
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
  for (int frame = 0; frame < PassTimes::timed_every; ++frame) play(times, {"alone"});
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

TEST_F(PassTimesTest, AddUpToTheFrameThoughPassesShareAFramebuffer) {
  constexpr int side = 2048;
  const Texture texture = texture_2d(GL_RGBA32F, side, side, 2);
  const Framebuffer target = Framebuffer::create();
  glNamedFramebufferTexture(target.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
  const auto work = [&](int steps) {
    for (int i = 0; i < steps; ++i) {
      const GLfloat colour[4]{float(i), 0.5f, 0.25f, 1.0f};
      glClearNamedFramebufferfv(target.name(), GL_COLOR, 0, colour);
      glGenerateTextureMipmap(texture.name());  // reads it: the driver cannot leave the clearing out
    }
  };
  work(1);  // makes what the driver needs once
  PassTimes times;
  glFinish();
  const auto began = std::chrono::steady_clock::now();
  times.begin_frame();
  work(2), times.end_pass("short");
  work(10), times.end_pass("long");
  glFinish();
  const double frame_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  times.begin_frame();
  ASSERT_EQ(times.latest().size(), 2u);
  const double short_s = times.latest()[0].seconds, long_s = times.latest()[1].seconds;
  EXPECT_GT(short_s + long_s, 0.9 * frame_s) << short_s << " " << long_s << " of " << frame_s;
  EXPECT_LE(short_s + long_s, 1.1 * frame_s);
  EXPECT_GT(long_s, 2.0 * short_s);
}

}  // namespace
}  // namespace parvis::gl
