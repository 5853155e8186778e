// What counts as no light of a sky, and that drawn skies are looked at.
#include "bench/light/sky_samples.h"

#include <gtest/gtest.h>

#include <limits>

#include "graphics/gl/test_context.h"

namespace parvis::bench {
namespace {

TEST(SkySamples, AreBadWhereTheyAreNoRadiance) {
  const auto is_bad = [](glm::vec3 radiance, bool has_light) {
    SkySamples samples;
    samples.add(radiance, has_light);
    return samples.all == 1 && samples.bad == 1;
  };
  EXPECT_FALSE(is_bad({0.2f, 0.0f, 0.1f}, true));
  EXPECT_FALSE(is_bad(glm::vec3(0.0f), false)) << "a night may be black";
  EXPECT_TRUE(is_bad(glm::vec3(0.0f), true)) << "a clamp leaves this of a negative sample";
  EXPECT_TRUE(is_bad({0.2f, 0.2f, -1e-6f}, false));
  EXPECT_TRUE(is_bad({0.2f, std::numeric_limits<float>::quiet_NaN(), 0.2f}, true));
  EXPECT_TRUE(is_bad({0.2f, std::numeric_limits<float>::infinity(), 0.2f}, true));
}

TEST(SkySamples, AreToHaveLightInTwilightAboveTheHorizon) {
  EXPECT_TRUE(has_light(10.0, false));
  EXPECT_TRUE(has_light(-4.0, true));
  EXPECT_FALSE(has_light(-4.0, false)) << "the ground may be black";
  EXPECT_FALSE(has_light(-4.5, true)) << "night";
}

class DrawnSamples : public gl::ContextTest {};

TEST_F(DrawnSamples, OfAModelBelowZeroAreBad) {
  constexpr float brighter_than_any = 1e4f;  // W/m2/sr
  Result<DrawnSky> drawn = DrawnSky::create();
  ASSERT_TRUE(drawn) << to_string(drawn.errors());
  const auto sky = light::make_sky(light::SkyKind::preetham, light::Air{3.0}, sun_at(30.0));
  ASSERT_TRUE(sky) << to_string(sky.errors());
  const Result<SkySamples> shipped = drawn->samples(**sky),
                           darker = drawn->samples(DarkerSky(*sky, brighter_than_any));
  ASSERT_TRUE(shipped) << to_string(shipped.errors());
  ASSERT_TRUE(darker) << to_string(darker.errors());
  EXPECT_GT(shipped->all, 50'000);
  EXPECT_EQ(shipped->bad, 0);
  EXPECT_GT(darker->bad, darker->all / 2) << "all but the sun's disc and what the filter mixes with it";
}

TEST_F(DrawnSamples, ShowADome) {
  Result<DrawnSky> drawn = DrawnSky::create();
  ASSERT_TRUE(drawn) << to_string(drawn.errors());
  const auto sky = light::make_sky(light::SkyKind::preetham, light::Air{3.0}, sun_at(30.0));
  ASSERT_TRUE(sky) << to_string(sky.errors());
  light::DayLight day;
  day.dome = std::make_shared<const ImageF>(64, 32, 3, 0.2f);  // overcast
  const Result<SkySamples> shipped = drawn->samples(**sky, day);
  ASSERT_TRUE(shipped) << to_string(shipped.errors());
  EXPECT_EQ(shipped->bad, 0);
  day.dome = std::make_shared<const ImageF>(64, 32, 3, 0.0f);
  const Result<SkySamples> black = drawn->samples(**sky, day);
  ASSERT_TRUE(black) << to_string(black.errors());
  EXPECT_GT(black->bad, black->all / 3) << "its land is drawn";
}

}  // namespace
}  // namespace parvis::bench
