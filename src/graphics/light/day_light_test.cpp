#include "graphics/light/day_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "base/colour.h"
#include "base/image_io.h"
#include "base/test_folder.h"
#include "graphics/light/cloud_cover.h"
#include "graphics/light/room.h"
#include "scene/script/live_scene.h"
#include "scene/script/room.h"
#include "scene/script/scene_loader.h"

namespace parvis::light {
namespace {

const scene::NodeRegistry& registry() {
  static const House house = [] {
    House all;
    script::furnish(all);
    light::furnish(all);
    return all;
  }();
  return house.get<scene::NodeRegistry>();
}

Result<scene::LoadedScene> load(const TestFolder& folder, const std::string& script) {
  folder.write("scene.xp", script);
  return scene::load_scene(folder.path() / "scene.xp", registry());
}

TEST(DayLightNode, TheThesissExampleAsPrinted) {
  const TestFolder folder;
  const auto loaded = load(folder,
                           "dayLight( lattitude=43.70, longitude=7.27,\nstandartMeridian=0, julianDay=130,\n"
                           "timeOfDay=16.00, turbidy=4 )\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  const glm::vec3 to_sun = loaded->scene.sun.direction_to_sun;
  EXPECT_LT(to_sun.x, -0.6f);  // an afternoon: the sun is in the west
  EXPECT_GT(to_sun.z, 0.4f);
  const ImageF& sky = loaded->scene.sky.picture;
  ASSERT_EQ(sky.width, 2 * sky.height);
  for (const float value : sky.pixels) ASSERT_GE(value, 0.0f);
  // The brightest part of the sky is about the sun.
  int best = 0;
  for (int i = 0; i < sky.width * sky.height / 2; ++i)
    if (sky.pixels[std::size_t(3 * i + 1)] > sky.pixels[std::size_t(3 * best + 1)]) best = i;
  const float azimuth = (float(best % sky.width) / float(sky.width) - 0.5f) * 6.2831853f;
  EXPECT_NEAR(azimuth, std::atan2(to_sun.x, to_sun.y), 0.15f);
  EXPECT_GT(loaded->scene.exposure, 0.0f);
  EXPECT_LT(loaded->scene.exposure, 0.5f);
}

TEST(DayLightNode, SaysWhatIsWrong) {
  const TestFolder folder;
  const auto message = [&](const std::string& script) {
    const auto loaded = load(folder, script);
    return loaded ? std::string() : loaded.errors().front().message;
  };
  EXPECT_NE(message("dayLight(latitude=91)").find("latitude"), std::string::npos);
  EXPECT_NE(message("dayLight(julianDay=0)").find("julianDay"), std::string::npos);
  EXPECT_EQ(message("dayLight(julianDay=366)"),
            "day=366 is not from 1 (1 January) to 365 (31 December 2026)");
  EXPECT_EQ(message("dayLight(julianDay=366, year=2024)"), "");
  EXPECT_NE(message("dayLight(timeOfDay=24.5)").find("timeOfDay"), std::string::npos);
  EXPECT_EQ(message("dayLight(timeOfDay=24)"),
            "time of day=24 is not from 0 to below 24 hours (14.25 is 14:15)");
  EXPECT_NE(message("dayLight(turbidity=0)").find("turbidity"), std::string::npos);
  EXPECT_NE(message("dayLight(turbidity=200)").find("turbidity"), std::string::npos);
  EXPECT_NE(message("skyDome(texture=\"no_such.hdr\")"), "");
}

TEST(DayLightNode, ReplacesSunAndSkyWhateverTheirOrder) {
  const TestFolder folder;
  const auto alone = load(folder, "dayLight()");
  ASSERT_TRUE(alone) << to_string(alone.errors());
  for (const char* others : {"sun()\nsky()\ndayLight()", "dayLight()\nsun()\nsky(intensity=3)"}) {
    const auto loaded = load(folder, others);
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    EXPECT_EQ(loaded->scene.sun, alone->scene.sun) << others;
    EXPECT_EQ(loaded->scene.sky.file, alone->scene.sky.file) << others;
    EXPECT_EQ(loaded->scene.sky.intensity, 1.0f) << others;
  }
}

TEST(SunNode, DoesNotShineFromBelowTheHorizon) {
  const TestFolder folder;
  for (const char* below : {"sun(elevation_deg=-10)", "sun(direction=\"0 1 -0.2\")"}) {
    const auto loaded = load(folder, below);
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    EXPECT_EQ(loaded->scene.sun.irradiance, glm::vec3(0.0f)) << below;
  }
  const auto above = load(folder, "sun(elevation_deg=10)");
  ASSERT_TRUE(above) << to_string(above.errors());
  EXPECT_GT(above->scene.sun.irradiance.y, 1.0f);
}

TEST(DayLightNode, ASkyDomeWithoutItIsRefused) {
  const TestFolder folder;
  for (const char* script : {"skyDome()", "sun()\nsky()\nskyDome()"}) {
    const auto loaded = load(folder, script);
    ASSERT_FALSE(loaded) << script;
    EXPECT_NE(loaded.errors().front().message.find("add dayLight"), std::string::npos) << script;
  }
  EXPECT_TRUE(load(folder, "skyDome()\ndayLight()"));
}

TEST(DayLightNode, PolarNightIsDarkAndNoError) {
  const TestFolder folder;
  const auto loaded = load(folder, "dayLight(latitude=78.2, longitude=15.6, julianDay=355, timeOfDay=12)");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_EQ(loaded->scene.sun.irradiance, glm::vec3(0.0f));
  EXPECT_LT(loaded->scene.sun.direction_to_sun.z, 0.0f);
}

TEST(DayLightNode, AMessageChangesTheHour) {
  const TestFolder folder;
  auto loaded = load(folder, "dayLight(timeOfDay=12)\nskyDome()\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene& scene = loaded->scene;
  const scene::Sun noon = scene.sun;
  const float exposure = scene.exposure;
  const std::filesystem::path file_before = scene.sky.file;
  scene::LiveScene live(std::move(loaded->script));
  const scene::Node* node = live.find("%dayLight");
  ASSERT_NE(node, nullptr);
  const Result<scene::Message> message = scene::parse_message(*node->schema, "timeOfDay 19", {});
  ASSERT_TRUE(message) << to_string(message.errors());
  ASSERT_TRUE(live.receive(*node, *message));
  EXPECT_TRUE(live.refresh(scene).empty());
  EXPECT_LT(scene.sun.direction_to_sun.z, noon.direction_to_sun.z);
  EXPECT_GT(scene.exposure, exposure);
  EXPECT_NE(scene.sky.file, file_before);
  // An hour that is none leaves everything as it was.
  const scene::Sun evening = scene.sun;
  const Result<scene::Message> late = scene::parse_message(*node->schema, "timeOfDay 24", {});
  if (late && live.receive(*node, *late)) {
    EXPECT_FALSE(live.refresh(scene).empty());
  }
  EXPECT_EQ(scene.sun, evening);
}

/// The thesis spells turbidity "turbidy", in scripts and so in messages.
TEST(DayLightNode, AMessageKnowsTheSpellingsOfTheScript) {
  const TestFolder folder;
  auto loaded = load(folder, "dayLight(turbidy=3)\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::LiveScene live(std::move(loaded->script));
  const scene::Node* node = live.find("%dayLight");
  for (const char* text : {"turbidity 6", "turbidy 8"}) {
    const Result<scene::Message> message = scene::parse_message(*node->schema, text, {});
    ASSERT_TRUE(message) << to_string(message.errors());
    ASSERT_TRUE(live.receive(*node, *message));
    EXPECT_TRUE(live.refresh(loaded->scene).empty());
  }
  EXPECT_FLOAT_EQ(loaded->scene.data<DayLight>().air.turbidity, 8.0f);
  EXPECT_FALSE(scene::parse_message(*node->schema, "turbid 8", {}));
}

TEST(DayLightNode, TheScriptsExposureMultiplies) {
  const TestFolder folder;
  const auto plain = load(folder, "dayLight()\n");
  ASSERT_TRUE(plain) << to_string(plain.errors());
  for (const char* script : {"exposure(value=2)\ndayLight()\n", "dayLight()\nexposure(value=2)\n"}) {
    const auto loaded = load(folder, script);
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    EXPECT_FLOAT_EQ(loaded->scene.exposure, 2.0f * plain->scene.exposure);
  }
  const auto without = load(folder, "exposure(value=2)\n");
  ASSERT_TRUE(without) << to_string(without.errors());
  EXPECT_FLOAT_EQ(without->scene.exposure, 2.0f);
}

TEST(SunPathNode, ArcsStandWhereTheSunGoes) {
  const TestFolder folder;
  const auto loaded = load(folder,
                           "dayLight(latitude=43.70, longitude=7.27, standardMeridian=1, timeOfDay=15)\n"
                           "sunPath(julianDay=172, radius=10, position=\"5 0 0\")\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  ASSERT_EQ(loaded->scene.objects.size(), 1u);
  const scene::Object& path = loaded->scene.objects.front();
  const Mesh& arc = path.model->parts.front().mesh;
  EXPECT_FALSE(path.model->parts.front().casts_shadow);
  float nearest_m = 1e9f, top_m = 0.0f;
  for (const glm::vec3 p : arc.positions) {
    EXPECT_NEAR(glm::length(p), 10.0f, 0.2f);
    nearest_m = std::min(nearest_m, glm::distance(p, 10.0f * loaded->scene.sun.direction_to_sun));
    top_m = std::max(top_m, p.z);
  }
  EXPECT_LT(nearest_m, 0.2f) << "the bead at 15 o'clock";
  EXPECT_NEAR(top_m, 10.0f * std::sin(glm::radians(69.74f)), 0.2f) << "midsummer's noon";
  EXPECT_EQ(path.world_from_model[3].x, 5.0f);
}

TEST(SunPathNode, PolarNightHasTheHorizonAloneAndWrongDaysAreNamed) {
  const TestFolder folder;
  const auto dark = load(folder, "dayLight(latitude=80, longitude=20)\nsunPath(julianDay=355)\n");
  ASSERT_TRUE(dark) << to_string(dark.errors());
  EXPECT_EQ(dark->scene.objects.front().model->parts.size(), 1u);
  const auto without = load(folder, "sunPath()\n");
  ASSERT_FALSE(without);
  EXPECT_NE(to_string(without.errors()).find("needs a dayLight before it"), std::string::npos);
  const auto late = load(folder, "dayLight(year=2026)\nsunPath(julianDay=366)\n");
  ASSERT_FALSE(late);
  EXPECT_NE(to_string(late.errors()).find("365"), std::string::npos);
}

TEST(SkyDome, CloudsOfThePhotographStandInTodaysLight) {
  // A dome of blue with one grey patch in the south, half way up; land below.
  auto dome = std::make_shared<ImageF>(128, 64, 3);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) {
      const bool is_cloud = y > 20 && y < 28 && (x < 8 || x > 120);
      const glm::vec3 colour = y >= 32    ? glm::vec3(0.2f, 0.25f, 0.1f)
                               : is_cloud ? glm::vec3(3.0f)
                                          : glm::vec3(0.2f, 0.4f, 1.0f);
      for (int c = 0; c < 3; ++c) dome->at(x, y)[c] = colour[c];
    }
  DayLight day;
  day.dome = dome;
  const auto sky = make_sky(day.kind, day.air, sun_of({.day_of_year = 172, .time_of_day_h = 18.0})).value();
  const ImageF with = sky_picture(*sky, day, 256);
  day.dome = nullptr;
  const ImageF without = sky_picture(*sky, day, 256);
  EXPECT_GT(with.at(0, 48)[0], 1.3f * without.at(0, 48)[0]);     // cloud is redder than the sky
  EXPECT_FLOAT_EQ(with.at(128, 48)[0], without.at(128, 48)[0]);  // clear sky is the model's
  EXPECT_GT(with.at(10, 120)[1], 1.5f * with.at(10, 120)[2]);    // the land is the photograph's green
}

TEST(Exposure, DuskIsDarkerThanNoonButSeen) {
  const float noon = 146.0f, dusk = 0.1f, night = 1e-6f;
  EXPECT_NEAR(noon * exposure_for(noon), 10.0f, 1e-3f);
  EXPECT_GT(dusk * exposure_for(dusk), 2.0f);
  EXPECT_LT(dusk * exposure_for(dusk), 7.0f);
  EXPECT_LT(night * exposure_for(night), 0.1f);
}

}  // namespace
}  // namespace parvis::light
