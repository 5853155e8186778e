#include "scene/script/scene_loader.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "life/traffic/demand.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"
#include "scene/script/test_registries.h"
#include "scene/script/test_script.h"
#include "scene/script/thesis_examples.h"

namespace parvis::scene {
namespace {

using namespace attribute;

/// Scripts in a folder of their own, and what the loader says of them.
class SceneLoader : public ScriptTest<> {
 protected:
  SceneLoader() : ScriptTest(house_with_print()) {}

  const NodeRegistry& registry_ = registries_.get<NodeRegistry>();

 private:
  /// Those of a scene, and a node with attributes of further types.
  static Registries house_with_print() {
    Registries registries = test_registries();
    NodeRegistry& registry = registries.get<NodeRegistry>();
    registry.add({.type = "print",
                  .attributes = {choice("paper", "", {"plain", "glossy"}),
                                 integer("resolution", "").in("pixels").between(8, 4096)}},
                 [](const Node&, SceneBuilder&) {});
    return registries;
  }
};

void expect_near(glm::vec3 a, glm::vec3 b) {
  EXPECT_LT(glm::length(a - b), 1e-4f) << a.x << " " << a.y << " " << a.z;
}

TEST_F(SceneLoader, ReadsLightAndAir) {
  const Scene scene = scene_of(
      "sun(azimuth_deg=90, elevation_deg=30, irradiance=\"#FFFFFF\")\nsky(intensity=0.5, heading_deg=90)\n"
      "air(haze_per_m=0.001)\nexposure(value=2)");
  expect_near(scene.sun.direction_to_sun, {std::sqrt(0.75f), 0.0f, 0.5f});
  expect_near(scene.sun.irradiance, glm::vec3(1.0f));
  EXPECT_FLOAT_EQ(scene.sky.intensity, 0.5f);
  EXPECT_FLOAT_EQ(scene.sky.heading, glm::half_pi<float>());
  EXPECT_FLOAT_EQ(scene.haze_per_m, 0.001f);
  EXPECT_FLOAT_EQ(scene.exposure, 2.0f);
}

TEST_F(SceneLoader, AnEmptyScriptIsAnEmptyScene) {
  const Scene scene = scene_of("");
  EXPECT_TRUE(scene.objects.empty());
  EXPECT_EQ(scene.exposure, Scene().exposure);
}

TEST_F(SceneLoader, DefaultsOfNodesAreThoseOfTheScene) {
  const Scene scene = scene_of("sun() sky() air() exposure()"), plain;
  expect_near(scene.sun.direction_to_sun, glm::normalize(plain.sun.direction_to_sun));
  expect_near(scene.sun.irradiance, plain.sun.irradiance);
  EXPECT_EQ(scene.sky.intensity, plain.sky.intensity);
  EXPECT_EQ(scene.exposure, plain.exposure);
}

TEST_F(SceneLoader, CamerasLookWhereHeadingAndTargetSay) {
  const Scene scene = scene_of(
      "camera(name=\"north\")\ncamera(name=\"east\", heading_deg=90)\ncamera(name=\"up\", pitch_deg=90)\n"
      "camera(name=\"aimed\", position=\"1 2 3\", target=\"1 2 0\", fov_deg=90)\n"
      "group(position=\"10 0 0\", heading_deg=90, scale=2) { camera(name=\"turned\", position=\"0 1 0\") }");
  expect_near(scene.find_camera("north")->camera.forward_in_world(), {0, 1, 0});
  expect_near(scene.find_camera("east")->camera.forward_in_world(), {1, 0, 0});
  expect_near(scene.find_camera("up")->camera.forward_in_world(), {0, 0, 1});
  expect_near(scene.find_camera("aimed")->camera.forward_in_world(), {0, 0, -1});
  expect_near(scene.find_camera("turned")->camera.position_in_world(), {12, 0, 0});
  expect_near(scene.find_camera("turned")->camera.forward_in_world(), {1, 0, 0});
  EXPECT_NEAR(glm::tan(scene.find_camera("aimed")->camera.vertical_fov / 2), 9.0f / 16.0f, 1e-5f);
}

TEST_F(SceneLoader, SuggestsTheNearestNodeAttributeChoiceAndName) {
  EXPECT_TRUE(holds(errors_of("\n camrea(name=a)"),
                    "scene.xp:2:2: unknown node type \"camrea\"; did you mean \"camera\"?"));
  EXPECT_TRUE(holds(errors_of("camera(name=a, postion=\"1 2 3\")"),
                    "scene.xp:1:16: camera has no attribute \"postion\"; did you mean \"position\"?"));
  EXPECT_TRUE(
      holds(errors_of("print(paper=\"glossi\")"), "scene.xp:1:13: paper=\"glossi\": expected one of"));
  EXPECT_TRUE(holds(errors_of("print(paper=\"glossi\")"), "did you mean \"glossy\"?"));
  EXPECT_TRUE(holds(errors_of("group(name=\"square\")\ncamera(name=a, follows=\"squaer\")"),
                    "no node of the scene has this name; did you mean \"square\"?"));
}

TEST_F(SceneLoader, ReportsAllErrorsAtOnceWithTheirPlaces) {
  const std::string errors = errors_of(
      "camera(position=\"1 2\")\nsun(elevation_deg=91)\nprint(resolution=12.5)\nsky(intensity=dark)\n"
      "group(scale=0)\nexposure(value=1e999)\nsun()\nair(haze_per_m=nan)");
  for (const char* expected : {"1:1: camera needs name=", "1:17: position=\"1 2\": expected three numbers",
                               "2:19: elevation_deg=\"91\"", "from -90 to 90",
                               "3:18: resolution=\"12.5\": expected a whole number in pixels from 8 to 4096",
                               "4:15:", "5:13:", "6:16: value=\"1e999\"",
                               "7:1: a scene has one sun; scene.xp:2 has given it already", "8:16:"})
    EXPECT_TRUE(holds(errors, expected)) << expected << "\nin\n" << errors;
}

/// Appendix A of the thesis: its nodes come with the rooms that show them; until then each is named, with its
/// line.
TEST_F(SceneLoader, NodesOfTheThesisThatHaveNoRoomYetAreNamed) {
  const std::string errors =
      errors_of(std::string(thesis_examples) + "group(name=trees) { }\nexposure(value=-1)\n");
  for (const char* expected :
       {"scene.xp:1:1: unknown node type \"vdobject\"",
        "scene.xp:9:1: unknown node type \"litVirtualObject\"", "scene.xp:16:16: value=\"-1\""})
    EXPECT_TRUE(holds(errors, expected)) << expected << "\nin\n" << errors;
}

TEST_F(SceneLoader, RefusesRepeatsAndDuplicateNames) {
  EXPECT_TRUE(holds(errors_of("sky(intensity=1, intensity=2)"), "scene.xp:1:18: intensity is given twice"));
  EXPECT_TRUE(holds(errors_of("camera(name=a)\ngroup(name=a)"),
                    "scene.xp:2:12: the name \"a\" is taken: scene.xp:1"));
  EXPECT_TRUE(holds(errors_of("group(name=\"\")"), "the name is empty"));
}

TEST_F(SceneLoader, RefusesContradictions) {
  EXPECT_TRUE(holds(errors_of("sun(direction=\"0 0 1\", azimuth_deg=1)"), "not both"));
  EXPECT_TRUE(holds(errors_of("sun(direction=\"0 0 0\")"), "no length"));
  EXPECT_TRUE(holds(errors_of("camera(name=a, target=\"0 0 1.6\")"), "the target lies in the eye"));
  EXPECT_TRUE(holds(errors_of("camera(name=a, target=\"9 9 9\", pitch_deg=2)"), "not both"));
}

TEST_F(SceneLoader, KnowsWhereNodesMayStand) {
  EXPECT_TRUE(holds(errors_of("sun() { air() }"), "scene.xp:1:9: sun takes no children"));
}

TEST_F(SceneLoader, IncludesStandInTheFrameOfTheirPlace) {
  folder_.write("parts/lamp.xp", "camera(name=\"lamp\", position=\"0 0 4\")");
  const Scene scene = scene_of("group(position=\"5 0 0\") { include(file=\"parts/lamp.xp\") }");
  expect_near(scene.find_camera("lamp")->camera.position_in_world(), {5, 0, 4});
}

TEST_F(SceneLoader, FilesAreRelativeToTheScriptThatNamesThem) {
  folder_.write("fleet/cars/red.xp", "include(file=\"lights/low.xp\")\ninclude(file=\"../sky/dusk.xp\")");
  folder_.write("fleet/cars/lights/low.xp", "camera(name=\"beside the script\")");
  folder_.write("fleet/sky/dusk.xp", "camera(name=\"in the folder above\")");
  const Scene scene = scene_of("include(file=\"fleet/cars/red.xp\")");
  EXPECT_NE(scene.find_camera("beside the script"), nullptr);
  EXPECT_NE(scene.find_camera("in the folder above"), nullptr);

  // The script's own folder comes before that of the scene, which follows, as in scripts written for it.
  folder_.write("fleet/cars/near.xp", "exposure(value=2)");
  folder_.write("near.xp", "exposure(value=3)");
  folder_.write("fleet/cars/far.xp", "include(file=\"near.xp\")\ninclude(file=\"of_the_scene.xp\")");
  folder_.write("of_the_scene.xp", "camera(name=\"of the scene\")");
  const Scene both = scene_of("include(file=\"fleet/cars/far.xp\")");
  EXPECT_EQ(both.exposure, 2.0f);
  EXPECT_NE(both.find_camera("of the scene"), nullptr);
}

TEST_F(SceneLoader, FilesBesideAScriptInADataFolderAreFound) {
  folder_.write("data/place/place.xp", "include(file=\"light.xp\")");
  folder_.write("data/place/light.xp", "exposure(value=5)");
  data_folders_ = {folder_.path() / "data"};
  const auto scene = folder_.write("inner/scene.xp", "include(file=\"place/place.xp\")");
  const auto loaded = load_scene(scene, registry_, data_folders_);
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_EQ(loaded->scene.exposure, 5.0f);
}

TEST_F(SceneLoader, AnIncludedScriptLeadsNowhereElse) {
  folder_.write("secret.xp", "sun()");
  folder_.write("inner/parts/lamp.xp", "include(file=\"../../secret.xp\")\ninclude(file=\"absent.xp\")");
  const auto refused =
      load_scene(folder_.write("inner/scene.xp", "include(file=\"parts/lamp.xp\")"), registry_);
  ASSERT_FALSE(refused);
  ASSERT_EQ(refused.errors().size(), 2u) << to_string(refused.errors());
  EXPECT_TRUE(holds(refused.errors()[0].message, "leads out"));
  EXPECT_TRUE(holds(refused.errors()[1].message, "there is no file \"absent.xp\""));
  EXPECT_TRUE(holds(refused.errors()[1].message, "beside the script, too ("));
}

TEST_F(SceneLoader, IncludesStandWhereTheirNodesMay) {
  folder_.write("lamp.xp", "camera(name=\"lamp\")");
  EXPECT_TRUE(holds(errors_of("traffic(vehicles=0) { include(file=\"lamp.xp\") }"),
                    "lamp.xp:1:1: camera does not stand in traffic, which takes include, model"));
  EXPECT_TRUE(holds(errors_of("include(file=\"lamp.xp\") { sun() }"), "include takes no children"));
}

TEST_F(SceneLoader, RoadsBecomeLanes) {
  const Scene scene = scene_of(
      "group(position=\"100 0 0\") { road(path=\"0 0, 50 0\", path=\"70 0, 100 0\", lanes=2, speed_km_h=36) "
      "}\n"
      "traffic(vehicles=3, seed=9)\ncamera(name=chase, follows=\"vehicle 3\", offset=\"-5 0 2\")");
  ASSERT_FALSE(scene.roads.empty());
  for (const Lane& lane : scene.roads.lanes) {
    EXPECT_FLOAT_EQ(lane.speed_limit, 10.0f);
    for (const glm::vec3& point : lane.points) EXPECT_GT(point.x, 80.0f);
  }
  EXPECT_EQ(scene.data<traffic::TrafficDemand>().vehicles, 3);
  EXPECT_EQ(scene.data<traffic::TrafficDemand>().seed, 9u);
  EXPECT_EQ(scene.find_camera("chase")->follows, "vehicle 3");
  EXPECT_TRUE(holds(errors_of("traffic(vehicles=3)\ncamera(name=chase, follows=\"vehicle 4\")"),
                    "did you mean \"vehicle"));
}

TEST_F(SceneLoader, ACameraThatFollowsLooksAtTheObjectOrByItsOwnHeadingFromIt) {
  Scene scene = scene_of(
      "road(path=\"0 0, 50 0\")\ntraffic(vehicles=1)\ncamera(name=chase, follows=\"vehicle 1\", offset=\"-7 "
      "0 1.8\")\n"
      "camera(name=seat, follows=\"vehicle 1\", offset=\"0.5 0.4 1.2\", heading_deg=90, pitch_deg=30)");
  Object car;
  car.name = "vehicle 1";
  car.world_from_model =
      glm::mat4({0, 1, 0, 0}, {-1, 0, 0, 0}, {0, 0, 1, 0}, {100, 20, 3, 1});  // heads north
  scene.objects = {car};
  const Result<Camera> chase = scene.camera_now(*scene.find_camera("chase")),
                       seat = scene.camera_now(*scene.find_camera("seat"));
  ASSERT_TRUE(chase && seat);
  EXPECT_LT(glm::distance(chase->position_in_world(), glm::vec3(100, 13, 4.8f)), 1e-3f);
  EXPECT_GT(chase->forward_in_world().y, 0.98f);
  EXPECT_LT(glm::distance(seat->position_in_world(), glm::vec3(99.6f, 20.5f, 4.2f)), 1e-3f);
  EXPECT_LT(glm::distance(seat->forward_in_world(), glm::vec3(std::sqrt(0.75f), 0, 0.5f)), 1e-5f)
      << "to the right, upward";
  EXPECT_NEAR(seat->world_from_camera[0].z, 0.0f, 1e-5f) << "level";

  const Result<LoadedScene> loaded =
      load_scene(folder_.write("scene.xp",
                               "road(path=\"0 0, 50 0\")\ntraffic(vehicles=1)\n"
                               "camera(name=eye, follows=\"vehicle 1\", target=\"1 2 3\")"),
                 registry_);
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_TRUE(holds(to_string(loaded->warnings), "target= is not used")) << to_string(loaded->warnings);
}

TEST_F(SceneLoader, ACameraRollsClockwiseAboutItsLineOfSight) {
  const Scene scene = scene_of(
      "camera(name=level, position=\"0 0 2\", heading_deg=90)\n"
      "camera(name=rolled, position=\"0 0 2\", heading_deg=90, pitch_deg=10, roll_deg=30)\n"
      "camera(name=aimed, position=\"0 0 2\", target=\"9 0 2\", roll_deg=-30)");
  const auto right = [&](const char* name) {
    return glm::vec3(scene.find_camera(name)->camera.world_from_camera[0]);
  };
  EXPECT_NEAR(right("level").z, 0.0f, 1e-6f);
  EXPECT_NEAR(right("rolled").z, -0.5f * std::cos(glm::radians(10.0f)), 1e-5f) << "its right side goes down";
  EXPECT_NEAR(right("aimed").z, 0.5f, 1e-5f);
  EXPECT_NEAR(scene.find_camera("rolled")->camera.forward_in_world().z, std::sin(glm::radians(10.0f)), 1e-5f);
}

TEST_F(SceneLoader, BadRoadsAreReportedAtTheirPath) {
  EXPECT_TRUE(holds(errors_of("\nroad(path=\"1 1, 1 1\")"), "scene.xp:2:11:"));
  EXPECT_TRUE(holds(errors_of("road(path=\"1 1\")"), "two or more points"));
  EXPECT_TRUE(holds(errors_of("road(path=\"1 1, 2 x\")"), "two or more points"));
}

TEST_F(SceneLoader, RandomEditsOfAScriptNeverCrash) {
  const std::string valid =
      "group(name=\"g\", position=\"1 2 3\", heading_deg=30) { # c\n camera(name=\"a\", target=\"10 20 3\")\n"
      "  road(path=\"0 0, 50 0, 70 20\", lanes=2)\n}\nsun(irradiance=\"#AABBCC\")\nair(haze_per_m=0.001)\n"
      "traffic(vehicles=12)\ncamera(name=b, follows=\"vehicle 1\")\ninclude(file=\"part.xp\")\n";
  folder_.write("part.xp", "exposure(value=2)\nprint(paper=plain)");
  const std::string bytes = "(){}=,\"\\#/ \n.-01e9axz\xff";
  Random random(11);
  for (int round = 0; round < 3000; ++round) {
    std::string text = valid;
    for (int edit = random.index(4); edit >= 0; --edit) {
      const std::size_t at = std::size_t(random.index(int(text.size())));
      const char byte = bytes[std::size_t(random.index(int(bytes.size())))];
      if (random.chance(0.6f))
        text[at] = byte;
      else if (random.chance(0.5f))
        text.insert(at, 1, byte);
      else
        text.erase(at, std::size_t(1 + random.index(8)));
    }
    const auto loaded = load(text);
    EXPECT_TRUE(loaded || !loaded.errors().empty());
  }
}

TEST_F(SceneLoader, ErrorsInIncludedFilesNameThem) {
  folder_.write("lamp.xp", "\nlampp()");
  EXPECT_TRUE(
      holds(errors_of("include(file=\"lamp.xp\")\ncamera()"), "lamp.xp:2:1: unknown node type \"lampp\""));
  EXPECT_TRUE(holds(errors_of("include(file=\"lamp.xp\")\ncamera()"), "scene.xp:2:1: camera needs name="));
}

TEST_F(SceneLoader, NamesTheChainOfACyclicInclude) {
  folder_.write("a.xp", "include(file=\"b.xp\")");
  folder_.write("b.xp", "\ninclude(file=\"./a.xp\")");
  EXPECT_TRUE(holds(errors_of("include(file=\"a.xp\")"),
                    "b.xp:2:14: files include each other in a circle: a.xp -> b.xp -> a.xp"));
  EXPECT_TRUE(holds(errors_of("include(file=\"scene.xp\")"), "scene.xp -> scene.xp"));
}

TEST_F(SceneLoader, IncludesThatMultiplyEndInAnError) {
  for (int i = 0; i < 14; ++i) {
    const std::string next = fmt::format("include(file=\"{}.xp\")\n", i + 1);
    folder_.write(fmt::format("{}.xp", i), next + next + next + next);
  }
  folder_.write("14.xp", "group()");
  EXPECT_TRUE(holds(errors_of("include(file=\"0.xp\")"), "includes more than"));
}

TEST_F(SceneLoader, NothingLeadsOutOfTheSceneFolder) {
  const TestFolder& outside = folder_;
  outside.write("secret.xp", "sun()");
  const auto scene = outside.write("inner/scene.xp",
                                   "include(file=\"../secret.xp\")\n"
                                   "include(file=\"link.xp\")\n"
                                   "include(file=\"" +
                                       (outside.path() / "secret.xp").string() +
                                       "\")\n"
                                       "include(file=\"linked/secret.xp\")\n"
                                       "include(file=\"absent.xp\")\ninclude(file=\".\")\n");
  std::filesystem::create_symlink(outside.path() / "secret.xp", outside.path() / "inner/link.xp");
  std::filesystem::create_directory_symlink(outside.path(), outside.path() / "inner/linked");
  const auto refused = load_scene(scene, registry_);
  ASSERT_FALSE(refused);
  ASSERT_EQ(refused.errors().size(), 6u) << to_string(refused.errors());
  for (int i = 0; i < 4; ++i) {
    EXPECT_TRUE(holds(refused.errors()[std::size_t(i)].message, "leads out")) << to_string(refused.errors());
    EXPECT_EQ(refused.errors()[std::size_t(i)].where.line, i + 1);
  }
  EXPECT_TRUE(holds(refused.errors()[4].message, "there is no file \"absent.xp\""));
  EXPECT_TRUE(holds(refused.errors()[5].message, "is a folder"));
}

TEST_F(SceneLoader, DataFoldersOpenTheirFilesOnly) {
  const auto scene = folder_.write("inner/scene.xp", "include(file=\"light.xp\")");
  folder_.write("data/light.xp", "exposure(value=3)");
  EXPECT_FALSE(load_scene(scene, registry_));
  const std::vector<std::filesystem::path> data{folder_.path() / "data"};
  const auto loaded = load_scene(scene, registry_, data);
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  EXPECT_EQ(loaded->scene.exposure, 3.0f);
  EXPECT_TRUE(check_scene(scene, registry_, data));
}

TEST_F(SceneLoader, AMissingOrUnreadableScriptIsAnError) {
  EXPECT_FALSE(load_scene(folder_.path() / "absent.xp", registry_));
  EXPECT_FALSE(load_scene(folder_.path(), registry_));
  EXPECT_TRUE(holds(errors_of(std::string("sun()\n\0", 7)), "scene.xp:2:1: this is not a text file"));
}

TEST_F(SceneLoader, AnUnreadablePictureIsReported) {
  folder_.write("sky.hdr", "no picture");
  EXPECT_TRUE(holds(errors_of("sky(file=\"sky.hdr\")"), "scene.xp:1:10: "));
}

}  // namespace
}  // namespace parvis::scene
