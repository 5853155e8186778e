#include "capture/trees/matte.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>

#include "base/random.h"

namespace parvis::trees {
namespace {

/// A soft green disc before a sky whose blue changes a little, and its alpha.
struct Composite {
  Image8 photograph{96, 96, 3};
  std::vector<float> alpha;

  Composite() {
    Random random(2);
    for (int y = 0; y < 96; ++y)
      for (int x = 0; x < 96; ++x) {
        const float r = glm::length(glm::vec2(float(x) - 48.0f, float(y) - 48.0f));
        const float a = glm::clamp(
            (34.0f - r) / 16.0f + 0.2f * random.uniform(-1.0f, 1.0f) * (r > 18.0f && r < 34.0f), 0.0f, 1.0f);
        const glm::vec3 green = glm::vec3(50.0f, 90.0f, 30.0f) + 14.0f * random.uniform(-1.0f, 1.0f);
        const glm::vec3 sky = glm::vec3(150.0f, 180.0f, 235.0f) + 0.08f * float(y);
        const glm::vec3 c = glm::mix(sky, green, a);
        for (int k = 0; k < 3; ++k) photograph.at(x, y)[k] = std::uint8_t(std::lround(c[k]));
        alpha.push_back(a);
      }
  }
  double rmse(const Image8& rgba) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < alpha.size(); ++i) {
      const double d = double(rgba.pixels[4 * i + 3]) / 255.0 - double(alpha[i]);
      sum += d * d;
    }
    return std::sqrt(sum / double(alpha.size()));
  }
};

/// A quarter of the photograph's size: a red frame and a green spot.
Image8 scribbles(bool has_background = true) {
  Image8 result(24, 24, 4, 255);
  for (int i = 0; i < 24; ++i)
    for (int k = 0; has_background && k < 3; ++k)
      for (const auto& [x, y] : {std::pair{i, k}, std::pair{k, i}})
        result.at(x, y)[1] = result.at(x, y)[2] = 0;
  for (int y = 10; y < 14; ++y)
    for (int x = 10; x < 14; ++x) result.at(x, y)[0] = result.at(x, y)[2] = 0;
  return result;
}

/// Gradient error: mean difference of alpha's changes from pixel to pixel (Rhemann and others 2009).
double gradient_error(const Composite& composite, const Image8& rgba) {
  double sum = 0.0;
  for (int y = 0; y + 1 < 96; ++y)
    for (int x = 0; x + 1 < 96; ++x)
      for (const int step : {1, 96}) {
        const auto i = std::size_t(y * 96 + x), k = i + std::size_t(step);
        sum += std::abs((double(rgba.pixels[4 * k + 3]) - double(rgba.pixels[4 * i + 3])) / 255.0 -
                        double(composite.alpha[k] - composite.alpha[i]));
      }
  return sum / (2.0 * 95.0 * 95.0);
}

TEST(Matte, TheLaplacianLetsAlphaFlowBetweenTheZones) {
  const Composite composite;
  const Zones zones = *zones_of_scribbles(scribbles(), 96, 96, "a");
  const Result<Image8> found = matte(composite.photograph, zones, "a", MatteMethod::laplacian);
  ASSERT_TRUE(found.ok());
  EXPECT_LT(composite.rmse(*found), 0.08);
  EXPECT_LT(gradient_error(composite, *found), 0.04);
  // The control: zones alone, all between them half opaque.
  Image8 guessed = *found;
  for (std::size_t i = 0; i < zones.pixels.size(); ++i)
    if (zones.pixels[i] == Zone::unknown) guessed.pixels[4 * i + 3] = 128;
  EXPECT_GT(composite.rmse(guessed), 0.3);
}

TEST(Matte, FindsTheSkyWhoseBrightnessChanges) {
  const Composite composite;
  Image8 photograph = composite.photograph;  // the sky far brighter below: no common colour at the border
  for (int y = 0; y < 96; ++y)
    for (int x = 0; x < 96; ++x) {
      const float sky = 1.0f - composite.alpha[std::size_t(y * 96 + x)];
      for (int k = 0; k < 3; ++k)
        photograph.at(x, y)[k] =
            std::uint8_t(std::min(255.0f, float(photograph.at(x, y)[k]) + 0.6f * sky * (float(y) - 60.0f)));
    }
  const Result<Zones> zones = zones_of_sky(photograph, "a");
  ASSERT_TRUE(zones) << to_string(zones.errors());
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < zones->pixels.size(); ++i)
    wrong += (zones->pixels[i] == Zone::background && composite.alpha[i] > 0.2f) ||
             (zones->pixels[i] == Zone::foreground && composite.alpha[i] < 0.3f);
  EXPECT_LT(wrong, zones->pixels.size() / 100);
  const Result<Image8> found = matte(photograph, *zones, "a");
  ASSERT_TRUE(found) << to_string(found.errors());
  EXPECT_LT(composite.rmse(*found), 0.12);
  Image8 noise(64, 64, 3);
  Random random(3);
  for (std::uint8_t& value : noise.pixels) value = std::uint8_t(random.index(256));
  EXPECT_FALSE(zones_of_sky(noise, "noise"));
}

TEST(Matte, APictureMayHaveItsOwn) {
  Image8 picture(4, 4, 4, 255);
  EXPECT_FALSE(has_matte(picture));
  picture.at(1, 1)[3] = 100;
  EXPECT_TRUE(has_matte(picture));
  EXPECT_FALSE(has_matte(Image8(4, 4, 3, 10)));
}

TEST(Matte, FindsAlphaBetweenPaintedZones) {
  const Composite composite;
  const Result<Image8> found =
      matte(composite.photograph, *zones_of_scribbles(scribbles(), 96, 96, "a"), "a");
  ASSERT_TRUE(found.ok());
  EXPECT_LT(composite.rmse(*found), 0.06);
}

TEST(Matte, FindsAlphaBeforeAPlainBackgroundByItself) {
  const Composite composite;
  const Result<Zones> zones = zones_of_plain_background(composite.photograph, "a");
  ASSERT_TRUE(zones.ok());
  const Result<Image8> found = matte(composite.photograph, *zones, "a");
  ASSERT_TRUE(found.ok());
  EXPECT_LT(composite.rmse(*found), 0.08);
}

TEST(Matte, ForegroundIsPure) {
  const Composite composite;
  const Image8 found = *matte(composite.photograph, *zones_of_scribbles(scribbles(), 96, 96, "a"), "a");
  double blue = 0.0, count = 0.0;
  for (std::size_t i = 0; i < composite.alpha.size(); ++i)
    if (composite.alpha[i] > 0.3f && composite.alpha[i] < 0.7f) blue += found.pixels[4 * i + 2], count += 1.0;
  EXPECT_LT(blue / count, 60.0);  // the mixture has about 130, the leaves 30
}

TEST(Matte, NamesWhatIsMissing) {
  const auto message = [](const auto& result) { return result ? std::string() : to_string(result.errors()); };
  EXPECT_NE(
      message(zones_of_scribbles(scribbles(false), 96, 96, "tree.jpg")).find("tree.jpg: no background zone"),
      std::string::npos);
  Image8 noise(64, 64, 3);
  Random random(1);
  for (std::uint8_t& value : noise.pixels) value = std::uint8_t(random.index(256));
  EXPECT_NE(message(zones_of_plain_background(noise, "tree.jpg")).find("not plain"), std::string::npos);
  const Composite composite;
  EXPECT_FALSE(matte(composite.photograph, {96, 96, std::vector<Zone>(96 * 96, Zone::background)}, "a").ok());
  EXPECT_FALSE(matte(composite.photograph, {9, 9, std::vector<Zone>(81, Zone::background)}, "a").ok());
}

}  // namespace
}  // namespace parvis::trees
