// What benches of shadows take for the truth.
#include "bench/light/exact_sun.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scene/data/test_scene.h"

namespace parvis::bench {
namespace {

constexpr JudgedPixels all_pixels{40, 30, 1};

/// A roof over a part of the ground, opaque or of leaves.
scene::Scene roofed_ground(scene::Alpha alpha) {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(30), scene::matt(glm::vec3(0.5f))));
  scene::Material roof = scene::matt(glm::vec3(0.5f));
  roof.alpha_mode = alpha;
  add(scene, scene::model_of(scene::box({-3, -3, 4}, {3, 3, 4.2f}), roof));
  return scene;
}

/// From high above, straight down.
Camera from_above() {
  Camera camera;
  camera.world_from_camera = look_at({0, 0, 30}, {0, 0, 0}, {0, 1, 0});
  return camera;
}

const glm::dvec3 to_sun = glm::normalize(glm::dvec3(0.7, 0.0, 0.7));

SunShares shares_of(const SunPicture& picture) { return {picture.begin(), picture.end()}; }

TEST(ExactSun, HasTheShadowOfARoofBesideIt) {
  const scene::Scene scene = roofed_ground(scene::Alpha::opaque);
  const DoubleTracer tracer(opaque_twin(scene));
  const SunPicture picture = exact_sun(tracer, from_above(), all_pixels, to_sun);
  const auto at = [&](int x, int y) { return picture[std::size_t(y * all_pixels.width + x)]; };
  EXPECT_EQ(at(20, 15), 1) << "the roof itself";
  EXPECT_EQ(at(14, 15), 0) << "the ground that it shades, away from the sun";
  EXPECT_EQ(at(27, 15), 1) << "the ground toward the sun";
  WrongSun same, other;
  same.add(picture, shares_of(picture));
  EXPECT_EQ(same.wrong, 0);
  EXPECT_GT(same.pixels, 1000);
  other.add(exact_sun(tracer, from_above(), all_pixels, glm::dvec3(-to_sun.x, to_sun.y, to_sun.z)),
            shares_of(picture));
  EXPECT_GT(other.percent(), 1.0) << "the shadow lies on the other side";
}

TEST(ExactSun, IsUnknownWhereLeavesMayConcernAPixel) {
  const scene::Scene scene = roofed_ground(scene::Alpha::cutout);
  const DoubleTracer tracer(opaque_twin(scene)), leaves(rest_of_twin(scene));
  const SunPicture without = exact_sun(tracer, from_above(), all_pixels, to_sun),
                   with = exact_sun(tracer, from_above(), all_pixels, to_sun, &leaves);
  EXPECT_EQ(std::ranges::count(without, 1), std::ptrdiff_t(all_pixels.count())) << "the twin has no leaves";
  EXPECT_EQ(with[15 * 40 + 20], -1) << "leaves before the ground";
  EXPECT_EQ(with[15 * 40 + 14], -1) << "leaves between the ground and the sun";
  EXPECT_EQ(with[15 * 40 + 27], 1);
}

TEST(ExactSun, JudgesEveryStepOfAPicture) {
  const DoubleTracer tracer(opaque_twin(roofed_ground(scene::Alpha::opaque)));
  const JudgedPixels some{40, 30, 8};
  EXPECT_EQ(some.count(), 20u);
  const SunPicture every = exact_sun(tracer, from_above(), all_pixels, to_sun),
                   chosen = exact_sun(tracer, from_above(), some, to_sun);
  ASSERT_EQ(chosen.size(), 20u);
  for (int y = 0; y < some.rows(); ++y)
    for (int x = 0; x < some.columns(); ++x)
      EXPECT_EQ(chosen[std::size_t(y * some.columns() + x)], every[std::size_t(8 * y * 40 + 8 * x)]);
}

TEST(ExactSun, TurnsAControlsSunByExactlySoMuch) {
  for (const glm::vec3 sun : {glm::vec3(1, 0, 0.2f), glm::vec3(0, 1, 0.2f), glm::vec3(0.2f, 0.1f, 1)}) {
    const glm::dvec3 before = glm::normalize(glm::dvec3(sun)), after(turned_sun(sun, 2.0f));
    EXPECT_NEAR(glm::degrees(std::acos(glm::dot(before, after))), 2.0, 1e-3);
  }
}

}  // namespace
}  // namespace parvis::bench
