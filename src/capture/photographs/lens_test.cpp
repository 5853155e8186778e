// Every lens model against formulas worked by hand and against its own inverse.
#include "capture/photographs/lens.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/random.h"

namespace parvis::photographs {
namespace {

/// A lens of each model with distortion of the size that real lenses have.
Lens example(LensModel model) {
  static const std::array<std::array<double, max_lens_parameters>, lens_model_count> parameters{{
      {900, 640, 480},
      {900, 910, 650, 470},
      {900, 650, 470, -0.12},
      {900, 650, 470, -0.12, 0.03},
      {900, 910, 650, 470, -0.2, 0.05, 0.001, -0.002},
      {500, 505, 650, 470, 0.02, -0.01, 0.003, -0.0005},
      {900, 910, 650, 470, 0.3, -0.1, 0.001, -0.002, 0.02, 0.45, -0.05, 0.01},
      {900, 910, 650, 470, 0.9},
      {500, 650, 470, 0.03},
      {500, 650, 470, 0.03, -0.01},
      {500, 505, 650, 470, 0.02, -0.01, 0.001, -0.002, 0.003, -0.0005, 0.004, -0.003},
  }};
  return {model, 1280, 960, parameters[std::size_t(model)]};
}

TEST(Lens, EveryModelIsUndoneByItsInverse) {
  for (const LensModelInfo& model : lens_models()) {
    const Lens lens = example(model.model);
    for (double x = 0.5; x < 1280; x += 53)
      for (double y = 0.5; y < 960; y += 41) {
        const auto direction = direction_of(lens, {x, y});
        ASSERT_TRUE(direction) << model.name << " at " << x << ", " << y;
        EXPECT_NEAR(glm::length(*direction), 1.0, 1e-12);
        const auto back = pixel_of(lens, 7.5 * *direction);
        ASSERT_TRUE(back) << model.name << " at " << x << ", " << y;
        EXPECT_NEAR(back->x, x, 1e-5) << model.name;
        EXPECT_NEAR(back->y, y, 1e-5) << model.name;
      }
  }
}

TEST(Lens, PixelsCountDownwardFromTheTopLeft) {
  const Lens lens = pinhole_lens(1280, 960, 900, 910, 650, 470);
  const auto pixel = pixel_of(lens, {0.2, 0.1, -2.0});  // right of and above the axis
  ASSERT_TRUE(pixel);
  EXPECT_DOUBLE_EQ(pixel->x, 650 + 900 * 0.1);
  EXPECT_DOUBLE_EQ(pixel->y, 470 - 910 * 0.05);
  EXPECT_FALSE(pixel_of(lens, {0.0, 0.0, 1.0})) << "behind the camera";
}

TEST(Lens, OpencvTermsByHand) {
  const Lens lens = example(LensModel::opencv);
  // u = .3, v = -.2 (downward), r2 = .13: factor 1 - .2 * .13 + .05 * .0169 = .974845
  const auto pixel = pixel_of(lens, {0.3, 0.2, -1.0});
  ASSERT_TRUE(pixel);
  const double x = 0.3 * 0.974845 + 2 * 0.001 * 0.3 * -0.2 - 0.002 * (0.13 + 2 * 0.09);
  const double y = -0.2 * 0.974845 + 2 * -0.002 * 0.3 * -0.2 + 0.001 * (0.13 + 2 * 0.04);
  EXPECT_NEAR(pixel->x, 900 * x + 650, 1e-9);
  EXPECT_NEAR(pixel->y, 910 * y + 470, 1e-9);
}

TEST(Lens, FisheyesSeeBesideThemselves) {
  const Lens lens = example(LensModel::simple_radial_fisheye);
  const auto pixel = pixel_of(lens, {1.0, 0.0, 0.0});  // 90 degrees off the axis
  ASSERT_TRUE(pixel);
  const double angle = glm::radians(90.0);
  EXPECT_NEAR(pixel->x, 650 + 500 * angle * (1 + 0.03 * angle * angle), 1e-9);
  EXPECT_NEAR(pixel->y, 470, 1e-9);
  EXPECT_FALSE(pixel_of(lens, {0.0, 0.0, 1.0})) << "straight behind";
}

TEST(Lens, NothingAppearsBeyondTheFold) {
  const Lens barrel{LensModel::simple_radial, 1280, 960, {900, 640, 480, -0.3}};  // folds at r = 1 / sqrt(.9)
  EXPECT_TRUE(pixel_of(barrel, {1.0, 0.0, -1.0}));
  EXPECT_FALSE(pixel_of(barrel, {1.1, 0.0, -1.0}));
  EXPECT_FALSE(direction_of(barrel, {640 + 900 * 0.8, 480})) << "no radius reaches .8: the largest is .7027";
  EXPECT_TRUE(direction_of(barrel, {640 + 900 * 0.70, 480}));
}

TEST(Lens, AFieldOfViewOfNothingIsAPinhole) {
  for (const double omega : {0.0, 1e-5, 1e-3}) {
    const Lens lens{LensModel::fov, 1280, 960, {900, 900, 640, 480, omega}};
    const auto pixel = pixel_of(lens, {0.3, 0.0, -1.0});
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, 640 + 270, 1e-3) << omega;
  }
}

TEST(Lens, ResizedPicturesSeeTheSameDirections) {
  for (const LensModelInfo& model : lens_models()) {
    const Lens lens = example(model.model), half = resized(lens, 640, 480);
    const auto direction = direction_of(lens, {900, 300});
    ASSERT_TRUE(direction);
    const auto pixel = pixel_of(half, *direction);
    ASSERT_TRUE(pixel);
    EXPECT_NEAR(pixel->x, 450, 1e-5) << model.name;
    EXPECT_NEAR(pixel->y, 150, 1e-5) << model.name;
  }
}

TEST(Lens, ClipSpaceAgreesWithPixels) {
  const Lens lens = pinhole_lens(1280, 960, 900, 910, 650, 470);
  const glm::dvec3 position(0.3, -0.4, -2.5);
  const glm::dvec4 clip = clip_from_camera(lens, 0.1, 100.0) * glm::dvec4(position, 1.0);
  const auto pixel = pixel_of(lens, position);
  ASSERT_TRUE(pixel);
  EXPECT_NEAR((clip.x / clip.w + 1.0) * 640.0, pixel->x, 1e-9);
  EXPECT_NEAR((1.0 - clip.y / clip.w) * 480.0, pixel->y, 1e-9);
  const glm::dvec4 near_clip = clip_from_camera(lens, 0.1, 100.0) * glm::dvec4(0, 0, -0.1, 1.0);
  EXPECT_NEAR(near_clip.z / near_clip.w, -1.0, 1e-9);
}

TEST(Lens, HostileParametersEndWithoutAnAnswer) {
  Random random(5);
  const double extremes[] = {0.0, -1.0, 1e300, -1e300, std::nan(""), 1e-300, 3.0, INFINITY};
  for (int i = 0; i < 2000; ++i) {
    Lens lens{LensModel(i % lens_model_count), 100, 100, {}};
    for (double& value : lens.parameters) value = extremes[random.index(8)];
    if (const auto direction = direction_of(lens, {30, 40})) {
      EXPECT_NEAR(glm::length(*direction), 1.0, 1e-6);
    }
    if (const auto pixel = pixel_of(lens, {0.1, 0.2, -1.0})) {
      EXPECT_TRUE(std::isfinite(pixel->x));
    }
  }
}

TEST(Lens, NamesAreColmaps) {
  for (const LensModelInfo& model : lens_models()) EXPECT_EQ(lens_model_of_name(model.name), model.model);
  EXPECT_FALSE(lens_model_of_name("pinhole"));
}

}  // namespace
}  // namespace parvis::photographs
