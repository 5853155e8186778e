// The light of crowns without rays between leaves, against photographs that have them.
#include <gtest/gtest.h>

#include "graphics/reference/photograph.h"
#include "graphics/reference/tracer.h"
#include "scene/data/leaf_openness.h"
#include "scene/data/test_crown.h"

namespace parvis::reference {
namespace {

constexpr int picture_side = 48;

double mean_green(const ImageF& picture) {
  double sum = 0.0;
  for (int y = 0; y < picture_side; ++y)
    for (int x = 0; x < picture_side; ++x) sum += double(picture.at(x, y)[1]);
  return sum / (picture_side * picture_side);
}

/// A camera that looks into the middle of a crown under an even sky.
Camera into_crown() {
  Camera camera;
  camera.world_from_camera = look_at({0, -30, 5}, {0, 0, 0});
  camera.vertical_fov = 2.0f * std::atan(0.5f * scene::crown_m / 30.0f);
  return camera;
}

TEST(CrownLight, IsThatOfAPhotographWhereLeavesHideTheSkyFromEachOther) {
  scene::Scene scene;
  scene.sun.irradiance = glm::vec3(0.0f);
  scene::add(scene, scene::model_of(scene::crown(8000), scene::leaf_material({0.1f, 0.2f, 0.05f}, 0.3f)));
  const shading::SkyLight sky = shading::make_sky_light(ImageF(32, 16, 3, 1.0f), 1.0f, 0.0f);
  PhotographOptions photographed;
  photographed.samples_per_pixel = 64;
  const auto photograph =
      take_photograph(RayScene(scene), scene, sky, into_crown(), picture_side, picture_side, photographed);
  ASSERT_TRUE(photograph);
  TraceOptions traced;
  traced.progress.clear();
  const auto shown = [&] {
    return mean_green(
        trace_picture(RayScene(scene), scene, sky, into_crown(), picture_side, picture_side, traced)
            .radiance);
  };
  const double truth = mean_green(photograph->radiance), open = shown();
  find_leaf_openness(scene);
  const double found = shown();
  fmt::print("photograph {:.3f}, with openness {:.3f}, without {:.3f}\n", truth, found, open);
  EXPECT_NEAR(found, truth, 0.35 * truth);
  EXPECT_GT(open, 1.8 * truth);
}

}  // namespace
}  // namespace parvis::reference
