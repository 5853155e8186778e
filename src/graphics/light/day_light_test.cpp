#include "graphics/light/day_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "base/colour.h"
#include "base/image_io.h"
#include "base/registries.h"
#include "base/test_folder.h"
#include "graphics/light/cloud_cover.h"
#include "room_list.h"
#include "scene/action/scene_clock.h"
#include "scene/script/live_scene.h"
#include "scene/script/scene_loader.h"

namespace parvis::light {
namespace {

const Registries& registries() {
  static const Registries filled = [] {
    Registries all;
    script::register_room(all);
    light::register_room(all);
    return all;
  }();
  return filled;
}

const scene::NodeRegistry& registry() { return registries().get<scene::NodeRegistry>(); }

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
    EXPECT_EQ(loaded->scene.sky.version, alone->scene.sky.version) << others;
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
  const int version_before = scene.sky.version;
  scene::LiveScene live(std::move(loaded->script));
  const scene::Node* node = live.find("%dayLight");
  ASSERT_NE(node, nullptr);
  const Result<scene::Message> message = scene::parse_message(*node->schema, "timeOfDay 19", {});
  ASSERT_TRUE(message) << to_string(message.errors());
  ASSERT_TRUE(live.receive(*node, *message));
  EXPECT_TRUE(live.refresh(scene).empty());
  EXPECT_LT(scene.sun.direction_to_sun.z, noon.direction_to_sun.z);
  EXPECT_GT(scene.exposure, exposure);
  EXPECT_NE(scene.sky.version, version_before);
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

/// The vertices of the parts of one material of a sun path, in its own frame of radius 1; those that are put
/// away lie within the horizon.
std::vector<glm::vec3> shown_vertices(const scene::Object& path, int material) {
  std::vector<glm::vec3> shown;
  for (const scene::Part& part : path.model->parts) {
    if (part.material != material) continue;
    const glm::mat4& pose = path.pose[std::size_t(part.node)];
    if (glm::length(glm::vec3(pose[1])) < 0.5f) continue;
    for (const glm::vec3 p : part.mesh.positions) shown.emplace_back(pose * glm::vec4(p, 1.0f));
  }
  return shown;
}

constexpr int horizon = 0, of_days = 1, of_today = 2, of_sun_today = 3;  // materials of sun_path_model

glm::vec3 middle_of(const std::vector<glm::vec3>& points) {
  Bounds bounds;
  for (const glm::vec3 p : points) bounds.add(p);
  return bounds.centre();
}

TEST(SunPathNode, ArcsStandWhereTheSunGoes) {
  const TestFolder folder;
  const auto loaded = load(folder,
                           "dayLight(latitude=43.70, longitude=7.27, standardMeridian=1, timeOfDay=15)\n"
                           "sunPath(julianDay=172, radius=10, position=\"5 0 0\")\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  ASSERT_EQ(loaded->scene.objects.size(), 1u);
  const scene::Object& path = loaded->scene.objects.front();
  for (const scene::Part& part : path.model->parts) EXPECT_FALSE(part.casts_shadow);
  const std::vector<glm::vec3> arc = shown_vertices(path, of_days);
  ASSERT_FALSE(arc.empty());
  float nearest = 1e9f, top = 0.0f;
  for (const glm::vec3 p : arc) {
    EXPECT_NEAR(glm::length(p), 1.0f, 0.02f);
    nearest = std::min(nearest, glm::distance(p, loaded->scene.sun.direction_to_sun));
    top = std::max(top, p.z);
  }
  EXPECT_LT(nearest, 0.02f) << "the bead at 15 o'clock";
  EXPECT_NEAR(top, std::sin(glm::radians(69.74f)), 0.02f) << "midsummer's noon";
  EXPECT_TRUE(shown_vertices(path, of_today).empty()) << "today is the day that the node names";
  EXPECT_LT(glm::distance(middle_of(shown_vertices(path, of_sun_today)), loaded->scene.sun.direction_to_sun),
            1e-3f);
  EXPECT_EQ(path.world_from_model[3].x, 5.0f);
  EXPECT_EQ(path.world_from_model[2].z, 10.0f);
}

/// So that the present hour is seen among the others.
TEST(SunPathNode, TheSunIsLargerThanTheHoursAndSets) {
  const TestFolder folder;
  const auto night = load(folder, "dayLight(timeOfDay=1)\nsunPath()\n");
  ASSERT_TRUE(night) << to_string(night.errors());
  const scene::Object& path = night->scene.objects.front();
  EXPECT_TRUE(shown_vertices(path, of_sun_today).empty());
  float bead = 1e9f, sun = 0.0f;  // the smallest of each
  for (const scene::Part& part : path.model->parts) {
    const glm::vec3 size = part.mesh.bounds().size();
    const bool is_bead = part.material == of_days && size.x == size.z;
    if (is_bead) bead = std::min(bead, size.x);
    if (part.material == of_sun_today) sun = size.x;
  }
  EXPECT_GT(sun, 2.0f * bead);
}

TEST(SunPathNode, PolarNightHasTheHorizonAloneAndWrongDaysAreNamed) {
  const TestFolder folder;
  const auto dark =
      load(folder, "dayLight(latitude=80, longitude=20, julianDay=350)\nsunPath(julianDay=355)\n");
  ASSERT_TRUE(dark) << to_string(dark.errors());
  const scene::Object& path = dark->scene.objects.front();
  for (const int material : {of_days, of_today, of_sun_today})
    EXPECT_TRUE(shown_vertices(path, material).empty()) << material;
  EXPECT_FALSE(shown_vertices(path, horizon).empty());
  // What is put away lies inside the ring, which is 0.002 thick.
  for (const scene::Part& part : path.model->parts)
    if (part.material != horizon)
      for (const glm::vec3 p : part.mesh.positions) {
        const glm::vec3 at(path.pose[std::size_t(part.node)] * glm::vec4(p, 1.0f));
        EXPECT_LT(glm::length(glm::vec2(glm::length(glm::vec2(at)) - 1.0f, at.z)), 0.002f);
      }
  const auto without = load(folder, "sunPath()\n");
  ASSERT_FALSE(without);
  EXPECT_NE(to_string(without.errors()).find("needs a dayLight before it"), std::string::npos);
  const auto late = load(folder, "dayLight(year=2026)\nsunPath(julianDay=366)\n");
  ASSERT_FALSE(late);
  EXPECT_NE(to_string(late.errors()).find("365"), std::string::npos);
}

/// A scene that runs, with the processes of this room.
class RunningSunPath {
 public:
  explicit RunningSunPath(const std::string& script) : loaded_(load(folder_, script)) {
    EXPECT_TRUE(loaded_) << to_string(loaded_.errors());
    scene::LiveScene live(std::move(loaded_->script));
    EXPECT_TRUE(live.prepare_scenarios(loaded_->scene));
    clock_.emplace(registries().get<action::Processes>(), std::move(live), loaded_->scene);
  }
  scene::Scene& scene() { return loaded_->scene; }
  action::SceneClock& clock() { return *clock_; }
  const scene::Object& path() const { return loaded_->scene.objects.front(); }
  glm::vec3 sun() const { return middle_of(shown_vertices(path(), of_sun_today)); }
  void send(const std::string& target, const std::string& message) {
    const Status status = clock_->send(target, message);
    EXPECT_TRUE(status) << to_string(status.errors());
    clock_->advance(scene(), action::step_s);
  }

 private:
  TestFolder folder_;
  Result<scene::LoadedScene> loaded_;
  std::optional<action::SceneClock> clock_;
};

TEST(SunPathNode, TheSunMovesWithMessages) {
  RunningSunPath running("dayLight(julianDay=130, timeOfDay=9)\nsunPath()\n");
  const glm::vec3 morning = running.sun();
  EXPECT_LT(glm::distance(morning, running.scene().sun.direction_to_sun), 1e-3f);
  const std::vector<glm::vec3> today = shown_vertices(running.path(), of_today);
  running.send("%dayLight", "timeOfDay 16");
  EXPECT_GT(glm::distance(running.sun(), morning), 0.5f);
  EXPECT_LT(glm::distance(running.sun(), running.scene().sun.direction_to_sun), 1e-3f);
  EXPECT_FALSE(today.empty());
  EXPECT_EQ(shown_vertices(running.path(), of_today), today) << "the same day";
  // As the window and films set it: attributes, without a message.
  scene::LiveScene& live = running.clock().live();
  live.set(*live.find("%dayLight"), "timeOfDay", 12.0);
  running.clock().follow(running.scene());
  EXPECT_LT(glm::distance(running.sun(), running.scene().sun.direction_to_sun), 1e-3f);
}

TEST(SunPathNode, ArcsFollowTheDayAndThePlaceAndNoObjectIsAdded) {
  RunningSunPath running("dayLight(julianDay=172, latitude=43.7)\nsunPath(name=\"path\", julianDay=80)\n");
  // Beads stand 0.012 above the arc's highest point.
  const auto expect_noon = [&](int material, float elevation_deg) {
    float top = 0.0f;
    for (const glm::vec3 p : shown_vertices(running.path(), material)) top = std::max(top, p.z);
    EXPECT_NEAR(top, std::sin(glm::radians(elevation_deg)), 0.02f) << elevation_deg;
  };
  constexpr float tilt_deg = 23.44f;
  expect_noon(of_days, 90.0f - 43.7f);
  expect_noon(of_today, 90.0f - 43.7f + tilt_deg);
  running.send("%dayLight", "julianDay 355");
  expect_noon(of_days, 90.0f - 43.7f);
  expect_noon(of_today, 90.0f - 43.7f - tilt_deg);
  running.send("%dayLight", "latitude 60");
  expect_noon(of_days, 90.0f - 60.0f);
  running.send("path", "julianDay 172");
  expect_noon(of_days, 90.0f - 60.0f + tilt_deg);
  running.send("path", "radius 12");
  EXPECT_EQ(running.path().world_from_model[0].x, 12.0f);
  EXPECT_EQ(running.scene().objects.size(), 1u) << "renderers have the objects that the scene began with";
}

TEST(SunPathNode, FollowsAScenario) {
  RunningSunPath running(
      "dayLight(timeOfDay=9)\nsunPath()\nscenario(name=\"evening\") { override(of=\"%dayLight\", "
      "timeOfDay=18) }\n");
  const glm::vec3 morning = running.sun();
  ASSERT_TRUE(running.clock().live().choose(running.scene(), "evening"));
  running.clock().follow(running.scene());
  EXPECT_LT(running.sun().x, 0.0f) << "in the west";
  ASSERT_TRUE(running.clock().live().choose(running.scene(), scene::base_scene));
  running.clock().follow(running.scene());
  EXPECT_LT(glm::distance(running.sun(), morning), 1e-3f);
}

TEST(SunPathNode, TheLastDayOfALeapYearFollowsIntoTheNext) {
  RunningSunPath running("dayLight(year=2024)\nsunPath(julianDay=366)\n");
  running.send("%dayLight", "year 2026");
  EXPECT_FALSE(shown_vertices(running.path(), of_days).empty());
}

/// An impossible day has no part in the scene's data either: others read it.
TEST(DayLightNode, ADayThatTheYearLacksLeavesThePlaceAndTimeAsTheyWere) {
  RunningSunPath running("dayLight(year=2026, julianDay=80)\nsunPath()\n");
  const PlaceAndTime before = running.scene().data<DayLight>().when;
  running.send("%dayLight", "julianDay 366");
  EXPECT_EQ(running.scene().data<DayLight>().when, before);
  EXPECT_FALSE(running.clock().take_warnings().empty());
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
