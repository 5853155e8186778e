#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "base/test_folder.h"
#include "graphics/bounced_light/bounced_over.h"
#include "graphics/bounced_light/transfer_cache.h"
#include "graphics/gl/test_context.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/photograph.h"
#include "graphics/reference/tracer.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "scene/data/test_scene.h"

namespace parvis::bounced_light {
namespace {

using glm::vec3;

/// A narrow street whose eastern wall is in the sun, the western one, red, in its own shadow.
scene::Scene street() {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(40), scene::matt(vec3(0.4f))));
  add(scene, scene::model_of(scene::box({-14, -30, 0}, {-6, 30, 12}), scene::matt(vec3(0.7f, 0.3f, 0.2f))));
  add(scene, scene::model_of(scene::box({6, -30, 0}, {14, 30, 12}), scene::matt(vec3(0.7f))));
  scene.sun.direction_to_sun = glm::normalize(vec3(-0.5f, 0.1f, 0.9f));
  scene.sun.irradiance = vec3(9.0f, 8.5f, 7.5f);
  scene.data<scene::BouncedSettings>() = {true, 3.0f, 128};
  return scene;
}

shading::SkyLight sky_of(const scene::Scene& scene) {
  return shading::make_sky_light(scene.sky.picture, scene.sky.intensity, scene.sky.heading);
}

vec3 irradiance(const shading::BouncedLight& light, vec3 position, vec3 geometric_normal, vec3 normal) {
  return bounced_irradiance(light.cell(position, geometric_normal), normal);
}

TEST(Transfer, GroundGivesBackItsAlbedoOfTheLight) {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(60), scene::matt(vec3(0.5f, 0.4f, 0.3f))));
  scene.sun.direction_to_sun = glm::normalize(vec3(0.3f, 0.2f, 0.8f));
  scene.sky.intensity = 0.0f;
  const reference::RayScene rays(scene);
  const Transfer transfer(scene, rays, {true, 4.0f, 256});
  const shading::BouncedLight light = transfer.light(scene.sun, sky_of(scene));
  const vec3 expected = vec3(0.5f, 0.4f, 0.3f) * scene.sun.irradiance * scene.sun.direction_to_sun.z;
  const vec3 down = irradiance(light, {0, 0, 0.5f}, {0, 0, 1}, {0, 0, -1});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(down[c], expected[c], 0.05f * expected[c]);
  const vec3 wall = irradiance(light, {0, 0, 0.5f}, {0, 0, 1}, {1, 0, 0});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(wall[c], 0.5f * expected[c], 0.06f * expected[c]);
  EXPECT_LT(irradiance(light, {0, 0, 0.5f}, {0, 0, 1}, {0, 0, 1}).x, 0.02f * expected.x);
}

TEST(Transfer, AMirrorShowsWhatStandsBeforeIt) {
  scene::Scene scene;
  add(scene, scene::model_of(scene::ground(60), scene::matt(vec3(0.5f, 0.4f, 0.3f))));
  scene.sky.intensity = 0.0f;
  const reference::RayScene rays(scene);
  const shading::BouncedLight light =
      Transfer(scene, rays, {true, 4.0f, 256}).light(scene.sun, sky_of(scene));
  const vec3 ground =
      vec3(0.5f, 0.4f, 0.3f) * scene.sun.irradiance * scene.sun.direction_to_sun.z / glm::pi<float>();
  const shading::BouncedCell cell = light.cell({0, 0, 0.5f}, {1, 0, 0});
  // Two bands tell no horizon from a slope: half of the radiance at the horizon, a quarter too much below.
  EXPECT_NEAR(bounced_radiance(cell, {0, 0, -1}).x / ground.x, 1.25, 0.1);
  EXPECT_NEAR(bounced_radiance(cell, {1, 0, 0}).x / ground.x, 0.5, 0.1);
  EXPECT_LT(bounced_radiance(cell, {0, 0, 1}).x / ground.x, 0.03);
}

/// The picture's middle looks north, its right quarter east.
ImageF glowing_in_the_east() {
  ImageF picture(128, 64, 3, 0.2f);
  for (int y = 24; y < 32; ++y)  // up to 22 degrees above the horizon
    for (int x = 80; x < 112; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y)[c] = 8.0f;
  return picture;
}

TEST(Transfer, WallsOfAStreetHideTheGlowOfALowSun) {
  const scene::Scene scene = street();
  const reference::RayScene rays(scene);
  const Transfer transfer(scene, rays, {true, 3.0f, 128});
  const vec3 up(0, 0, 1), on_the_street(0, 0, 0.5f), above_the_roofs(0, 0, 14);
  const auto sky_at = [&](const ImageF& picture, vec3 place) {
    return transfer.light(scene.sun, shading::make_sky_light(picture, 1.0f, 0.0f)).cell(place, up).sky.x;
  };
  const ImageF glow = glowing_in_the_east(), even(128, 64, 3, 0.7f);
  EXPECT_LT(sky_at(glow, on_the_street), 0.5f);
  EXPECT_NEAR(sky_at(glow, above_the_roofs), 1.0f, 0.25f);
  EXPECT_NEAR(sky_at(even, on_the_street), 1.0f, 1e-3f);
  EXPECT_EQ(shading::BouncedLight().cell(on_the_street, up).sky, vec3(1.0f)) << "without any";
}

TEST(Transfer, IsLinearInSunAndSky) {
  scene::Scene scene = street();
  const reference::RayScene rays(scene);
  const Transfer transfer(scene, rays, {true, 6.0f, 64});
  const auto at = [&](float sun, float sky) {
    scene::Scene other = scene;
    other.sun.irradiance *= sun, other.sky.intensity *= sky;
    return irradiance(transfer.light(other.sun, sky_of(other)), {-5.9f, 0, 2}, {1, 0, 0}, {1, 0, 0}).x;
  };
  EXPECT_GT(at(1, 1), 0.1f);
  EXPECT_NEAR(at(3, 3), 3 * at(1, 1), 1e-4f * at(3, 3));
  // Cells have one colour each, so that mixing between cells of several colours is not quite linear.
  EXPECT_NEAR(at(1, 0) + at(0, 1), at(1, 1), 0.015f * at(1, 1));
  EXPECT_NEAR(at(3, 2), 3 * at(1, 0) + 2 * at(0, 1), 0.015f * at(3, 2));
}

TEST(Transfer, PlacesInsideOfThingsAreNone) {
  const scene::Scene scene = street();
  const reference::RayScene rays(scene);
  const Transfer transfer(scene, rays, {true, 3.0f, 64});
  const shading::BouncedLight light = transfer.light(scene.sun, sky_of(scene));
  EXPECT_LT(transfer.place_count(), light.lobes.size());
  for (const glm::vec4 lobe : light.lobes) ASSERT_TRUE(std::isfinite(lobe.x + lobe.y + lobe.z + lobe.w));
  const scene::Scene empty;
  const Transfer nothing(empty, reference::RayScene(empty), {true, 3.0f, 64});
  EXPECT_TRUE(nothing.light(scene.sun, sky_of(scene)).empty());
}

/// A street whose script lies in a folder.
class KeptTransfer : public testing::Test {
 protected:
  KeptTransfer() : scene_(street()) {
    scene_.file = folder_.path() / "street.xp";
    scene_.data<scene::BouncedSettings>() = {true, 6.0f, 32};
  }
  std::vector<glm::vec4> lobes(const Transfer& transfer) const {
    return transfer.light(scene_.sun, sky_of(scene_)).lobes;
  }

  TestFolder folder_;
  scene::Scene scene_;
};

TEST_F(KeptTransfer, IsReadAsItWasTracedAtEveryHour) {
  EXPECT_FALSE(TransferCache(scene_).read());
  const Transfer traced = trace_transfer(scene_);
  ASSERT_TRUE(TransferCache(scene_).keep(traced));
  scene_.sun.irradiance *= 0.5f, scene_.sky.intensity *= 3.0f;
  const std::optional<Transfer> kept = TransferCache(scene_).read();
  ASSERT_TRUE(kept);
  EXPECT_EQ(lobes(*kept), lobes(traced));
  EXPECT_EQ(kept->to_bytes(), traced.to_bytes());
}

TEST_F(KeptTransfer, OfAnotherSceneOrDamagedIsNotUsed) {
  ASSERT_TRUE(TransferCache(scene_).keep(trace_transfer(scene_)));
  const std::filesystem::path file = TransferCache(scene_).file();
  scene_.objects[1].world_from_model[3].x += 1.0f;
  EXPECT_FALSE(TransferCache(scene_).read());
  std::filesystem::copy(file, TransferCache(scene_).file());
  testing::internal::CaptureStderr();
  EXPECT_FALSE(TransferCache(scene_).read());
  EXPECT_NE(testing::internal::GetCapturedStderr().find("is of another scene"), std::string::npos);
  std::filesystem::resize_file(TransferCache(scene_).file(), 100);
  testing::internal::CaptureStderr();
  EXPECT_FALSE(TransferCache(scene_).read());
  EXPECT_NE(testing::internal::GetCapturedStderr().find("traced again"), std::string::npos);
}

TEST_F(KeptTransfer, BytesWhoseIndicesLieAreNone) {
  const std::string right = trace_transfer(scene_).to_bytes();
  ASSERT_TRUE(Transfer::from_bytes(right));
  constexpr std::size_t lists = sizeof(shading::BouncedGrid) + sizeof(glm::ivec3) + sizeof(int);
  for (const std::size_t at : {sizeof(shading::BouncedGrid), lists - sizeof(int), lists + 4}) {
    std::string wrong = right;
    wrong[at + 2] = '\x7f';  // 8 million cells along, rays, or the number of a place
    EXPECT_FALSE(Transfer::from_bytes(wrong)) << at;
  }
  EXPECT_FALSE(Transfer::from_bytes(right.substr(0, right.size() - 1)));
  EXPECT_FALSE(Transfer::from_bytes(right + "x"));
  EXPECT_FALSE(Transfer::from_bytes(""));
}

class BouncedPicture : public gl::ContextTest {};

/// What path-traced photographs of the shaded wall show that sun and sky alone do not.
TEST_F(BouncedPicture, IsNearerToThePhotographThanTheConstant) {
  constexpr int size = 64;
  scene::Scene scene = street();
  Camera camera;
  camera.world_from_camera = look_at({2, -12, 2.5f}, {-5, 4, 3});
  camera.vertical_fov = 0.9f;
  const reference::RayScene rays(scene);
  reference::PhotographOptions options;
  options.samples_per_pixel = 256;
  const auto truth = reference::take_photograph(rays, scene, sky_of(scene), camera, size, size, options);
  ASSERT_TRUE(truth) << to_string(truth.errors());
  const auto error = [&](bool is_bounced) {
    scene.data<scene::BouncedSettings>().is_on = is_bounced;
    auto renderer = render::Renderer::create(scene, {}, with_bounced_light(light::sun_and_sky));
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    EXPECT_TRUE(render::draw_frame(**renderer, scene, {camera, size, size}));
    const ImageF picture = (*renderer)->read_radiance();
    double off = 0.0, sum = 0.0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        for (int c = 0; c < 3; ++c) {
          const double expected = double(truth->radiance.at(x, y)[c]);
          off += std::abs(double(picture.at(x, y)[c]) - expected), sum += expected;
        }
    // The ray tracer reads the same light.
    const shading::DrawnLight light = (*renderer)->drawn_light();
    EXPECT_EQ(light.bounced != nullptr, is_bounced);
    reference::TraceOptions tracing;
    tracing.drawn_light = &light, tracing.samples_per_pixel = 4;
    const ImageF traced =
        reference::trace_picture(rays, scene, (*renderer)->sky(), camera, size, size, tracing).radiance;
    double apart = 0.0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) apart += double(std::abs(picture.at(x, y)[0] - traced.at(x, y)[0]));
    EXPECT_LT(apart / (sum / 3.0), 0.03);
    return off / sum;
  };
  const double with = error(true), without = error(false);
  std::printf("mean difference to the photograph: %.1f %% with, %.1f %% without bounced light\n", 100 * with,
              100 * without);
  EXPECT_LT(with, 0.6 * without);
}

}  // namespace
}  // namespace parvis::bounced_light
