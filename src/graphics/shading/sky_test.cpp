#include "graphics/shading/sky.h"

#include <gtest/gtest.h>

#include <glm/gtc/constants.hpp>

#include "base/random.h"
#include "base/test_directions.h"

namespace parvis::shading {
namespace {

vec3 irradiance(const SkyLight& sky, vec3 normal) {
  vec3 sh[9];
  std::copy(sky.irradiance_sh.begin(), sky.irradiance_sh.end(), sh);
  return sky_irradiance(sh, normal);
}

TEST(SkyLightTest, APictureOfTwoPixelsHasAllLevelsAndItsColours) {
  ImageF picture(2, 1, 3);
  picture.at(0, 0)[0] = 1.0f, picture.at(1, 0)[2] = 1.0f;
  const SkyLight sky = make_sky_light(picture, 1.0f, 0.0f);
  for (std::size_t level = 0; level < sky.levels.size(); ++level)
    EXPECT_EQ(std::max(sky.levels[level].width, 1), std::max(sky.levels[0].width >> level, 1));
  EXPECT_GE(sky.levels.back().width, 1);
  EXPECT_GE(sky.levels[0].width >> (sky.levels.size() - 1), 1) << "a texture has no level below one texel";
  EXPECT_GT(sky_picture_at(sky, {0.25f, 0.5f}).x, 0.9f);
  EXPECT_GT(sky_picture_at(sky, {0.75f, 0.5f}).z, 0.9f);
}

TEST(Sky, AConstantSkyIsConstantAtEveryBlur) {
  const SkyLight sky = make_sky_light(ImageF(128, 64, 3, 0.7f), 2.0f, 1.0f);
  ASSERT_GT(sky.levels.size(), 1u);
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const vec3 radiance =
        sky_radiance(sky, random_direction(random), random.uniform(0, float(sky.levels.size() - 1)));
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(radiance[c], 1.4f, 1e-4f);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sky.haze_radiance[c], 1.4f, 1e-4f);
}

TEST(Sky, AConstantSkyOfRadianceOneGivesIrradiancePi) {
  const SkyLight sky = make_sky_light(ImageF(256, 128, 3, 1.0f), 1.0f, 0.0f);
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const vec3 light = irradiance(sky, random_direction(random));
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(light[c], glm::pi<float>(), 0.02f);
  }
}

/// The poles, about which all columns of a picture lie, are tested, too.
TEST(Sky, APictureThatIsTurnedIsBlurredAsThePictureBefore) {
  Random random(3);
  ImageF picture(128, 64, 3), turned(128, 64, 3);
  for (float& value : picture.pixels) value = random.uniform(0, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) std::copy_n(picture.at(x, y), 3, turned.at((x + 64) % 128, y));
  const SkyLight before = make_sky_light(picture, 1.0f, 0.0f), after = make_sky_light(turned, 1.0f, 0.0f);
  for (std::size_t level = 0; level < before.levels.size(); ++level) {
    const ImageF &one = before.levels[level], &other = after.levels[level];
    for (int y = 0; y < one.height; ++y)
      for (int x = 0; x < one.width; ++x)
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(other.at((x + one.width / 2) % one.width, y)[c], one.at(x, y)[c], 1e-4f);
  }
}

/// A picture that is bright in its right quarter: east, at a heading of 0.
ImageF bright_in_the_east() {
  ImageF picture(128, 64, 3, 0.1f);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 80; x < 112; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 1.0f;
  return picture;
}

TEST(Sky, ItsPictureStandsByTheCompass) {
  const vec3 north(0, 1, 0), east(1, 0, 0), south(0, -1, 0), west(-1, 0, 0);
  const SkyLight plain = make_sky_light(bright_in_the_east(), 1.0f, 0.0f);
  EXPECT_NEAR(sky_radiance(plain, east, 0.0f).x, 1.0f, 1e-4f);
  for (const vec3 other : {north, south, west}) {
    EXPECT_NEAR(sky_radiance(plain, other, 0.0f).x, 0.1f, 1e-4f);
    EXPECT_LT(irradiance(plain, other).x, irradiance(plain, east).x);
  }
  const SkyLight turned =
      make_sky_light(bright_in_the_east(), 1.0f, 0.5f * glm::pi<float>());  // clockwise: now south
  EXPECT_NEAR(sky_radiance(turned, south, 0.0f).x, 1.0f, 1e-4f);
  EXPECT_NEAR(sky_radiance(turned, east, 0.0f).x, 0.1f, 1e-4f);
  EXPECT_NEAR(irradiance(turned, south).x, irradiance(plain, east).x, 0.02f);
}

TEST(Sky, APictureIsEvenInAzimuthAndElevation) {
  for (int row = 0; row <= 8; ++row)  // from the zenith to the nadir
    for (int column = 1; column < 16; ++column) {
      const float polar = glm::pi<float>() * float(row) / 8.0f,
                  azimuth = glm::pi<float>() * float(column - 8) / 8.0f;
      const vec3 direction(std::sin(polar) * std::sin(azimuth), std::sin(polar) * std::cos(azimuth),
                           std::cos(polar));
      const vec2 uv = equirect_uv(direction, 0.0f);
      EXPECT_NEAR(uv.y, float(row) / 8.0f, 1e-4f);
      if (row > 0 && row < 8) {
        EXPECT_NEAR(uv.x, float(column) / 16.0f, 1e-4f);
      }
    }
}

TEST(Sky, TheSunsDiscInAPhotographIsDimmed) {
  ImageF photograph(128, 64, 3, 1.0f);
  for (int c = 0; c < 3; ++c) photograph.at(64, 16)[c] = 50000.0f;
  const ImageF dimmed = without_sun(photograph);
  EXPECT_LT(dimmed.at(64, 16)[0], 100.0f);
  EXPECT_EQ(dimmed.at(10, 16)[0], 1.0f);
}

TEST(Sky, KeepsTheGlareOfAComputedSky) {
  ImageF computed(128, 64, 3, 1.0f);
  for (int c = 0; c < 3; ++c) computed.at(64, 16)[c] = 100.0f;
  EXPECT_EQ(make_sky_light(computed, 2.0f, 0.0f).levels.front().at(64, 16)[0], 200.0f);
}

TEST(Sky, WithoutAPictureItIsBlueAbove) {
  const SkyLight sky = make_sky_light({}, 1.0f, 0.0f);
  const vec3 zenith = sky_radiance(sky, {0, 0, 1}, 0.0f);
  EXPECT_GT(zenith.z, zenith.x);
  EXPECT_GT(irradiance(sky, {0, 0, 1}).y, irradiance(sky, {0, 0, -1}).y);
}

TEST(Haze, SwallowsTheViewAndShowsItself) {
  const vec3 radiance(1, 2, 3), haze(0.5f);
  EXPECT_EQ(through_haze(radiance, 0.0f, 0.01f, haze), radiance);
  EXPECT_EQ(through_haze(radiance, 1000.0f, 0.0f, haze), radiance);
  EXPECT_NEAR(through_haze(radiance, 1e6f, 0.01f, haze).z, 0.5f, 1e-5f);
  EXPECT_NEAR(through_haze(radiance, 100.0f, 0.01f, vec3(0.0f)).x, std::exp(-1.0f), 1e-5f);
}

}  // namespace
}  // namespace parvis::shading
