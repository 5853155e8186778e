// Numbers and directions are spread as they claim.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "graphics/reference/sample_sequence.h"
#include "graphics/reference/sky_sampler.h"

namespace parvis::reference {
namespace {

TEST(SampleSequence, TheFirst64FallOneIntoEachCellOfEveryGridOf64) {
  for (const auto& [columns, rows] : {std::pair{8, 8}, {64, 1}, {1, 64}, {4, 16}, {32, 2}})
    for (int use = 0; use < 3; ++use) {
      std::set<int> cells;
      for (std::uint32_t i = 0; i < 64; ++i) {
        SampleSequence numbers(1, 77, i);
        for (int skipped = 0; skipped < use; ++skipped) numbers.next_2d();
        const glm::vec2 p = numbers.next_2d();
        ASSERT_TRUE(p.x >= 0.0f && p.x < 1.0f && p.y >= 0.0f && p.y < 1.0f);
        cells.insert(int(p.x * float(columns)) * rows + int(p.y * float(rows)));
      }
      EXPECT_EQ(cells.size(), 64u) << columns << "x" << rows << " use " << use;
    }
}

TEST(SampleSequence, PixelsAndUsesAreIndependent) {
  double mean = 0.0, product = 0.0;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    SampleSequence numbers(1, std::uint32_t(i), 5);
    const double a = double(numbers.next_1d()), b = double(numbers.next_1d());
    mean += a / count, product += (a - 0.5) * (b - 0.5) / count;
  }
  EXPECT_NEAR(mean, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / count));
  EXPECT_NEAR(product, 0.0, 4.0 * (1.0 / 12.0) / std::sqrt(double(count)));
}

shading::SkyLight patchy_sky(float heading) {
  ImageF picture(64, 32, 3, 0.0f);
  for (int y = 4; y < 9; ++y)
    for (int x = 50; x < 58; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 2.0f;
  return shading::make_sky_light(picture, 1.0f, heading);
}

TEST(SkySampler, DirectionsAreAsDenseAsItSays) {
  const shading::SkyLight sky = patchy_sky(0.7f);
  const SkySampler sampler(sky);
  double sphere = 0.0, light = 0.0, even_light = 0.0;
  int matching = 0;
  const int count = 1 << 16;
  for (std::uint32_t i = 0; i < count; ++i) {
    SampleSequence numbers(1, 3, i);
    const SkySampler::Choice chosen = sampler.choose(numbers.next_2d());
    ASSERT_NEAR(glm::length(chosen.direction), 1.0f, 1e-5f);
    const glm::vec2 uv = shading::equirect_uv(chosen.direction, sky.heading);
    ASSERT_NEAR(chosen.uv.x, uv.x, 1e-4f);
    ASSERT_NEAR(chosen.uv.y, uv.y, 1e-3f);
    const double density = double(sampler.density(uv));
    ASSERT_GT(density, 0.0);
    matching += chosen.density == sampler.density(uv);
    sphere += 1.0 / density / count;
    light += double(shading::sky_radiance(sky, chosen.direction, 0.0f).x) / density / count;
    const glm::vec2 u = numbers.next_2d();
    const float z = 2.0f * u.x - 1.0f, radius = std::sqrt(1.0f - z * z), turn = 6.2831853f * u.y;
    const glm::vec3 even(radius * std::cos(turn), radius * std::sin(turn), z);
    even_light += double(shading::sky_radiance(sky, even, 0.0f).x) * 4.0 * 3.14159265 / count;
  }
  EXPECT_GT(matching, count * 0.99);  // rounding may carry a direction over a cell's edge
  EXPECT_NEAR(sphere, 4.0 * 3.14159265, 0.2);
  EXPECT_NEAR(light, even_light, 0.01 * even_light);
}

TEST(SkySampler, ADarkSkyIsDistinguished) {
  EXPECT_FALSE(SkySampler(shading::make_sky_light(ImageF(32, 16, 3, 0.0f), 1.0f, 0.0f)).shines());
  EXPECT_TRUE(SkySampler(patchy_sky(0.0f)).shines());
}

}  // namespace
}  // namespace parvis::reference
