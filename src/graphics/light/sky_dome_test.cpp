// The node skyDome: its picture in the scene's sky, under the light of every hour; and what scenes get of a
// sky against its model.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/colour.h"
#include "base/image_io.h"
#include "graphics/light/day_light.h"
#include "graphics/shading/sky.h"
#include "room_list.h"
#include "scene/script/live_scene.h"
#include "scene/script/test_script.h"

namespace parvis::light {
namespace {

class SkyDomeNode : public scene::ScriptTest<> {
 protected:
  SkyDomeNode() {
    script::register_room(registries_);
    light::register_room(registries_);
  }
  /// An overcast sky over dark land.
  void write_dome(int width, int height) const {
    ImageF dome(width, height, 3);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        for (int c = 0; c < 3; ++c) dome.at(x, y)[c] = 2 * y < height ? 1.0f : 0.1f;
    ASSERT_TRUE(write_image(folder_.path() / "dome.hdr", dome));
  }
  /// Blue over red, half way up in the north.
  static float blueness(const scene::Scene& scene) {
    const ImageF& sky = scene.sky.picture;
    const float* pixel = sky.at(sky.width / 2, sky.height / 4);
    return pixel[2] / pixel[0];
  }
};

TEST_F(SkyDomeNode, ShowsThePictureUnderTheLightOfEveryHour) {
  write_dome(64, 32);
  const scene::Scene clear = scene_of("dayLight(timeOfDay=12)\n");
  auto loaded = load("dayLight(timeOfDay=12)\nskyDome(texture=\"dome.hdr\")\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene& scene = loaded->scene;
  EXPECT_LT(blueness(scene), 0.8f * blueness(clear)) << "clouds are grey";
  const ImageF noon = scene.sky.picture;
  scene::LiveScene live(std::move(loaded->script));
  const scene::Node* node = live.find("%dayLight");
  ASSERT_NE(node, nullptr);
  const Result<scene::Message> evening = scene::parse_message(*node->schema, "timeOfDay 18", {});
  ASSERT_TRUE(evening) << to_string(evening.errors());
  ASSERT_TRUE(live.receive(*node, *evening));
  EXPECT_TRUE(live.refresh(scene).empty());
  const int x = noon.width / 2, y = noon.height / 4;
  ASSERT_EQ(scene.sky.picture.width, noon.width);
  EXPECT_LT(scene.sky.picture.at(x, y)[1], 0.7f * noon.at(x, y)[1]) << "the same clouds are darker";
  EXPECT_LT(blueness(scene), 0.8f * blueness(scene_of("dayLight(timeOfDay=18)\n")));
}

TEST_F(SkyDomeNode, RefusesAPictureOfAnotherShape) {
  write_dome(40, 32);
  const std::string errors = errors_of("dayLight(timeOfDay=12)\nskyDome(texture=\"dome.hdr\")\n");
  EXPECT_TRUE(holds(errors, "twice as wide as high; this one has 40 x 32 pixels")) << errors;
  EXPECT_TRUE(holds(errors, "scene.xp:2:")) << errors;
}

TEST(SkyOfScenes, HasTheIrradianceOfTheModelOnLevelGroundAndOnWalls) {
  for (const double elevation : {30.0, 70.0}) {
    const auto sky = make_sky(
        SkyKind::atmosphere, Air{3.0},
        {.azimuth_deg = 180.0, .zenith_deg = 90.0 - elevation, .geometric_elevation_deg = elevation});
    ASSERT_TRUE(sky) << to_string(sky.errors());
    shading::SkyLight light = shading::make_sky_light(sky_picture(**sky, {}, 512), 1.0f, 0.0f);
    for (const glm::vec3 normal : {glm::vec3(0, 0, 1), glm::vec3(0, -1, 0), glm::vec3(1, 0, 0)}) {
      const glm::vec3 all = (*sky)->irradiance_xyz(normal, 8192),
                      sun = std::max(glm::dot(normal, (*sky)->to_sun()), 0.0f) * (*sky)->sun_irradiance_xyz();
      const float of_scene = luminance(shading::sky_irradiance(light.irradiance_sh.data(), normal));
      EXPECT_NEAR(of_scene / (all.y - sun.y), 1.0f, 0.15f)
          << "nine harmonics, the sun at " << elevation << ", normal " << normal.x << " " << normal.y;
    }
  }
}

}  // namespace
}  // namespace parvis::light
