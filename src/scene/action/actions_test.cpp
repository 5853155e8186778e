#include "scene/action/actions.h"

#include <gtest/gtest.h>

#include "formats/gltf/gltf_writer.h"
#include "scene/action/scene_clock.h"
#include "scene/data/test_scene.h"
#include "scene/script/test_registries.h"
#include "scene/script/test_script.h"

namespace parvis::action {
namespace {

/// A scene that runs: scripts with a model file "box.glb", half a metre about its origin.
class ActionsTest : public scene::ScriptTest<> {
 protected:
  ActionsTest() : ScriptTest(scene::test_registries()) {
    const auto box = scene::model_of(scene::box(glm::vec3(-0.5f), glm::vec3(0.5f)), {});
    EXPECT_TRUE(scene::write_gltf(folder_.path() / "box.glb", *box));
  }

  void load(const std::string& script) {
    auto loaded = ScriptTest::load(script);
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    scene_ = std::move(loaded->scene);
    scene::LiveScene live(std::move(loaded->script));
    const Status status = live.prepare_scenarios(scene_);
    ASSERT_TRUE(status) << to_string(status.errors());
    clock_.emplace(registries_.get<Processes>(), std::move(live), scene_);
  }
  void advance(double seconds) { clock_->advance(scene_, seconds, {visitor_}); }
  Actions& actions() { return *clock_->find<Actions>(); }
  std::string warnings() { return to_string(clock_->take_warnings()); }

  bool sees(const std::string& name) const {
    for (const scene::Object& object : scene_.objects)
      if (object.name == name && object.is_visible) return true;
    return false;
  }
  glm::vec3 place(const std::string& name) const {
    for (const scene::Object& object : scene_.objects)
      if (object.name == name) return glm::vec3(object.world_from_model[3]);
    ADD_FAILURE() << "no object " << name;
    return {};
  }

  scene::Scene scene_;
  std::optional<SceneClock> clock_;
  std::optional<glm::vec3> visitor_;
};

void expect_near(glm::vec3 a, glm::vec3 b) {
  EXPECT_LT(glm::distance(a, b), 1e-3f) << a.x << " " << a.y << " " << a.z;
}

constexpr const char* trees =
    "group(name=trees) {\n"
    "  group(name=oaks, visible=0) { model(name=oak, file=\"box.glb\") }\n"
    "  group(name=oranges) { model(name=orange, file=\"box.glb\", position=\"3 0 0\") }\n"
    "}\n";

TEST_F(ActionsTest, AButtonShowsTheOaksAfterItsDelay) {
  load(std::string(trees) + "keys(onPress=\"button2, trees, show oaks, 0.5\", onrelease=\"h, oaks, hide\")");
  EXPECT_TRUE(sees("orange"));
  EXPECT_FALSE(sees("oak"));
  EXPECT_TRUE(actions().uses_key("button2"));
  EXPECT_FALSE(actions().uses_key("button3"));
  actions().press("button2");
  advance(0.49);
  EXPECT_FALSE(sees("oak"));
  advance(0.05);
  EXPECT_TRUE(sees("oak"));
  actions().press("h");
  advance(0.1);
  EXPECT_TRUE(sees("oak"));
  actions().release("h");
  advance(0.1);
  EXPECT_FALSE(sees("oak"));
  actions().press("button2", 2.0);
  advance(2.4);
  EXPECT_FALSE(sees("oak"));
  advance(0.2);
  EXPECT_TRUE(sees("oak"));
  EXPECT_EQ(warnings(), "");
}

TEST_F(ActionsTest, MessagesShowHideToggleAndChooseAmongBrothers) {
  load(trees);
  const auto send = [&](const char* target, const char* message) {
    const Status status = clock_->send(target, message);
    EXPECT_TRUE(status) << message;
    advance(step_s);
  };
  send("trees", "only oaks");
  EXPECT_TRUE(sees("oak") && !sees("orange"));
  send("trees", "only oranges");
  EXPECT_TRUE(!sees("oak") && sees("orange"));
  send("trees", "HIDE");
  EXPECT_TRUE(!sees("oak") && !sees("orange"));
  send("trees", "toggle");
  EXPECT_TRUE(!sees("oak") && sees("orange"));
  send("trees", "toggle oaks");
  EXPECT_TRUE(sees("oak") && sees("orange"));
  send("oak", "hide");
  EXPECT_TRUE(!sees("oak") && sees("orange"));
  EXPECT_FALSE(clock_->send("tree", "show"));
  EXPECT_FALSE(clock_->send("trees", "shine"));
  EXPECT_FALSE(clock_->send("trees", "show pines"));
}

TEST_F(ActionsTest, LiveAttributesAreMessages) {
  load(
      "group(name=square, position=\"10 0 0\", heading_deg=90) { model(name=bench, file=\"box.glb\", "
      "position=\"0 1 0\") }\nsun(elevation_deg=40)\nexposure(value=1)\ncamera(name=eye)");
  expect_near(place("bench"), {11, 0, 0});
  EXPECT_TRUE(clock_->send("square", "position 0 5 0"));
  EXPECT_TRUE(clock_->send("%sun", "elevation_deg 90"));
  EXPECT_TRUE(clock_->send("%exposure", "value 2"));
  EXPECT_TRUE(clock_->send("eye", "fov_deg 90"));
  EXPECT_FALSE(clock_->send("%sun", "elevation_deg 91"));
  advance(step_s);
  expect_near(place("bench"), {1, 5, 0});
  expect_near(scene_.sun.direction_to_sun, {0, 0, 1});
  EXPECT_EQ(scene_.exposure, 2.0f);
  EXPECT_NEAR(std::tan(scene_.find_camera("eye")->camera.vertical_fov / 2), 9.0f / 16.0f, 1e-5f);
  EXPECT_TRUE(clock_->send("bench", "heading_deg 30"));
  advance(step_s);
  expect_near(place("bench"), {1, 5, 0});
}

TEST_F(ActionsTest, ATimerSendsAtItsTimesAgainAndAgain) {
  load(
      "model(name=lamp, file=\"box.glb\", visible=0)\n"
      "timer(name=clock, period_s=4, onTime=\"1, lamp, show\", onTime=\"3, lamp, hide\")");
  for (int round = 0; round < 3; ++round) {
    advance(0.9);
    EXPECT_FALSE(sees("lamp"));
    advance(1.1);
    EXPECT_TRUE(sees("lamp"));
    advance(1.1);
    EXPECT_FALSE(sees("lamp"));
    advance(0.9);
  }
  EXPECT_TRUE(clock_->send("clock", "stop"));
  advance(2.0);
  EXPECT_FALSE(sees("lamp"));
  EXPECT_TRUE(clock_->send("clock", "start"));
  advance(1.5);
  EXPECT_TRUE(sees("lamp"));
}

TEST_F(ActionsTest, ProximityReportsWhoComesAndWhoLeaves) {
  load(
      "model(name=tram, file=\"box.glb\", position=\"-20 0 0\")\n"
      "model(name=bell, file=\"box.glb\", visible=0) model(name=light, file=\"box.glb\", visible=0)\n"
      "group(position=\"5 0 0\") { proximity(radius_m=4, onEnter=\"tram, bell, show\", onLeave=\"tram, bell, "
      "hide\",\n  onEnter=\"visitor, light, show\", onLeave=\"visitor, light, hide\") }\n"
      "path(of=tram, smooth=0) { key(time_s=0, position=\"-15 0 0\") key(time_s=4, position=\"25 0 0\") }");
  visitor_ = {5, 3, 0};
  advance(1.5);
  EXPECT_TRUE(sees("light"));
  EXPECT_FALSE(sees("bell"));
  advance(0.2);  // at 2 m: within 4 m of 5 m
  EXPECT_TRUE(sees("bell"));
  visitor_ = {5, 30, 0};
  advance(0.8);
  EXPECT_FALSE(sees("bell"));
  EXPECT_FALSE(sees("light"));
}

TEST_F(ActionsTest, PathsMoveObjectsGroupsAndCameras) {
  load(
      "group(name=tram, heading_deg=90) { model(name=car, file=\"box.glb\", position=\"2 0 0\") }\n"
      "camera(name=crane, position=\"0 0 2\", target=\"0 100 2\") camera(name=boom)\n"
      "path(name=line, of=tram, smooth=0, loop=1) { key(time_s=0, position=\"0 0 0\") key(time_s=2, "
      "position=\"8 0 "
      "0\") }\n"
      "path(of=crane, smooth=0) { key(time_s=0, position=\"0 0 2\") key(time_s=4, position=\"0 0 10\") }\n"
      "path(of=boom) { key(time_s=0, position=\"0 0 2\", heading_deg=350, pitch_deg=0) key(time_s=2, "
      "position=\"0 0 "
      "2\", heading_deg=10, pitch_deg=-60) }");
  EXPECT_TRUE(scene_.objects.at(0).is_dynamic);
  advance(0.75);
  expect_near(place("car"), {3, -2, 0});
  expect_near(scene_.find_camera("crane")->camera.position_in_world(), {0, 0, 3.5f});
  EXPECT_GT(scene_.find_camera("crane")->camera.forward_in_world().y, 0.99f);
  advance(0.25);
  expect_near(scene_.find_camera("boom")->camera.forward_in_world(),
              {0, std::cos(glm::radians(30.0f)), -std::sin(glm::radians(30.0f))});
  advance(1.5);
  expect_near(place("car"), {2, -2, 0});
  EXPECT_TRUE(clock_->send("line", "stop"));
  advance(step_s);
  const glm::vec3 halted = place("car");
  advance(1.0);
  expect_near(place("car"), halted);
  EXPECT_EQ(warnings(), "");
}

TEST_F(ActionsTest, AThingOnAPathMayLookWhereItGoes) {
  load(
      "model(name=tram, file=\"box.glb\") camera(name=cab)\n"
      "path(of=tram, along=1, smooth=0) { key(time_s=0, position=\"0 0 0\") key(time_s=1, position=\"0 5 "
      "0\") }\n"
      "path(of=cab, along=1, smooth=0) { key(time_s=0, position=\"0 0 0\") key(time_s=1, position=\"5 0 0\") "
      "}");
  advance(0.5);
  expect_near(glm::vec3(scene_.objects.at(0).world_from_model[0]), {0, 1, 0});
  expect_near(scene_.find_camera("cab")->camera.forward_in_world(), {1, 0, 0});
}

TEST_F(ActionsTest, AToursViewPassesThroughItsCameras) {
  load(
      "camera(name=a, position=\"0 0 2\", heading_deg=0, fov_deg=60) camera(name=b, position=\"10 0 2\", "
      "heading_deg=90, "
      "fov_deg=40)\ncamera(name=c, position=\"10 10 8\", target=\"0 0 0\")\n"
      "tour(name=walk) { stop(time_s=0, camera=a) stop(time_s=2, camera=b) stop(time_s=4, camera=c) }");
  EXPECT_FALSE(actions().camera(scene_));
  EXPECT_TRUE(holds(to_string(actions().start_tour("wlak").errors()), "did you mean \"walk\"?"));
  const auto length = actions().start_tour("walk");
  ASSERT_TRUE(length);
  EXPECT_EQ(*length, 4.0);
  for (const char* name : {"a", "b", "c"}) {
    const Camera expected = scene_.find_camera(name)->camera, camera = actions().camera(scene_).value();
    expect_near(camera.position_in_world(), expected.position_in_world());
    expect_near(camera.forward_in_world(), expected.forward_in_world());
    EXPECT_NEAR(camera.vertical_fov, expected.vertical_fov, 1e-4f);
    advance(1.0);
    EXPECT_NEAR(actions().camera(scene_)->world_from_camera[0].z, 0.0f, 1e-5f) << "no roll";
    advance(1.0);
  }
  actions().release_view();
  EXPECT_FALSE(actions().camera(scene_));
}

TEST_F(ActionsTest, AMessageSaysWhereToLookFrom) {
  load("camera(name=a) camera(name=b, position=\"4 5 6\")\nkeys(onPress=\"f2, b, look\")");
  actions().press("f2");
  advance(step_s);
  expect_near(actions().camera(scene_)->position_in_world(), {4, 5, 6});
}

TEST_F(ActionsTest, ACircleOfMessagesIsCutAndNamed) {
  load("timer(name=ping, onTime=\"0, pong, start\")\ntimer(name=pong, onTime=\"0, ping, start\")");
  advance(1.0);
  const std::string told = warnings();
  EXPECT_TRUE(holds(told, "scene.xp:")) << told;
  EXPECT_TRUE(holds(told, "causes itself without end")) << told;
  advance(1.0);
  EXPECT_EQ(warnings(), "") << "told once";
}

TEST_F(ActionsTest, AStormSpreadsOverStepsAndIsReported) {
  std::string script = "model(name=lamp, file=\"box.glb\", visible=0)\nkeys(";
  for (int i = 0; i < 9'999; ++i) script += "onPress=\"a, lamp, toggle\",\n";
  load(script + "onPress=\"a, lamp, show\")");
  actions().press("a");
  advance(step_s);
  const std::string told = warnings();
  EXPECT_TRUE(holds(told, "more than 1000 messages in one step")) << told;
  EXPECT_TRUE(holds(told, "\"toggle\" to \"lamp\"")) << told;
  advance(0.2);
  EXPECT_TRUE(sees("lamp")) << "nothing is lost";
  for (int i = 0; i < 12; ++i) actions().press("a");
  advance(step_s);
  EXPECT_TRUE(holds(warnings(), "was lost"));
}

TEST_F(ActionsTest, TheSameHappeningsGiveTheSameSceneAtAnyFrameRate) {
  const std::string script =
      std::string(trees) +
      "keys(onPress=\"x, trees, toggle oaks, 0.3\")\n"
      "path(of=oranges, loop=1) { key(time_s=0, position=\"0 0 0\") key(time_s=0.7, position=\"3 "
      "1 0\") key(time_s=1, position=\"5 5 0\") }\n"
      "timer(period_s=0.35, onTime=\"0.1, orange, toggle\")";
  std::vector<scene::Scene> results;
  for (const int frames_per_second : {10, 60, 200}) {
    load(script);
    for (int i = 0; i < 2 * frames_per_second; ++i) {
      if (i == frames_per_second) actions().press("x");
      advance(1.0 / frames_per_second);
    }
    results.push_back(scene_);
  }
  for (const scene::Scene& result : results)
    for (std::size_t i = 0; i < result.objects.size(); ++i) {
      EXPECT_EQ(result.objects[i].is_visible, results[0].objects[i].is_visible);
      expect_near(glm::vec3(result.objects[i].world_from_model[3]),
                  glm::vec3(results[0].objects[i].world_from_model[3]));
    }
}

TEST_F(ActionsTest, BadEventsAreReportedAtLoadWithTheirPlaces) {
  const std::string errors =
      errors_of(std::string(trees) +
                "keys(onPress=\"button2, tree, show oaks\")\n"
                "keys(onPress=\"button2, trees, shwo oaks\")\n"
                "keys(onPress=\"button2, trees, show oks\")\n"
                "keys(onPress=\"buton2, trees, show\")\n"
                "keys(onPress=\"a, trees, position 1 2\")\n"
                "keys(onPress=\"a, trees, show, soon\")\n"
                "timer(onTime=\"-1, trees, show\") proximity(onEnter=\"visitr, trees, show\")\n"
                "keys(onPress=\"a, trees\")");
  for (const char* expected :
       {"5:14: onPress: no node of the scene is called \"tree\"; did you mean \"trees\"?",
        "6:14: onPress: \"trees\": group takes no message \"shwo\"; did you mean \"show\"?",
        "7:14: onPress: \"show oks\": trees holds nothing to be seen that is called \"oks\"; did you mean "
        "\"oaks\"?",
        "8:14: onPress, its source=\"buton2\": expected one of", "did you mean \"button2\"?",
        "9:14: onPress: \"trees\": position=\"1 2\": expected three numbers",
        "10:14: onPress: the delay \"soon\" is no number", "11:14: onTime, its source=\"-1\"",
        "11:51: onEnter=\"visitr\": no node of the scene has this name; did you mean \"visitor\"?",
        "12:14: onPress=\"a, trees\": expected \"SOURCE, TARGET, MESSAGE, DELAY\""})
    EXPECT_TRUE(holds(errors, expected)) << expected << "\nin\n" << errors;
}

TEST_F(ActionsTest, BadPathsAndToursAreReportedAtLoad) {
  const std::string errors = errors_of(
      "group(name=g) { }\ncamera(name=c)\n"
      "path(of=g) { key(time_s=1, position=\"0 0 0\") key(time_s=1, position=\"1 0 0\") }\n"
      "path(of=g) { }\n"
      "path(of=g) { key(time_s=0, position=\"0 0 0\", heading_deg=3) key(time_s=1, position=\"1 0 0\") }\n"
      "path(of=g, onPass=\"3, g, hide\") { key(time_s=0, position=\"0 0 0\") }\n"
      "tour(name=t) { stop(time_s=5, camera=c) stop(time_s=2, camera=c) }");
  for (const char* expected :
       {"3:57: time_s=1 is not later than the key before", "4:1: the path has no keys",
        "5:61: this key gives no heading_deg", "6:19: onPass: the path has no key 3; it has 1",
        "7:53: time_s=2 is not later than the stop before"})
    EXPECT_TRUE(holds(errors, expected)) << expected << "\nin\n" << errors;
  EXPECT_TRUE(holds(errors_of("group(name=g) { }\ncamera(name=a)\ntour(name=t) { stop(time_s=0, camera=g) }"),
                    "this is a group; expected the name of a camera"));
}

}  // namespace
}  // namespace parvis::action
