#include "scene/script/live_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/image_io.h"
#include "formats/gltf/gltf_writer.h"
#include "life/traffic/demand.h"
#include "scene/data/test_scene.h"
#include "scene/script/attribute.h"
#include "scene/script/test_registries.h"
#include "scene/script/test_script.h"

namespace parvis::scene {
namespace {

class LiveSceneTest : public ScriptTest<> {
 protected:
  LiveSceneTest() : ScriptTest(test_registries()) {
    for (const char* name : {"small.glb", "large.glb"})
      EXPECT_TRUE(write_gltf(folder_.path() / name, *model_of(box(glm::vec3(0.0f), glm::vec3(1.0f)), {})));
  }

  Status prepare(const std::string& script) {
    auto loaded = ScriptTest::load(script);
    if (!loaded) return loaded.errors();
    scene_ = std::move(loaded->scene);
    live_ = LiveScene(std::move(loaded->script));
    return live_.prepare_scenarios(scene_);
  }
  void load(const std::string& script) {
    const Status status = prepare(script);
    ASSERT_TRUE(status) << to_string(status.errors());
  }
  std::string errors_of(const std::string& script) {
    const Status status = prepare(script);
    EXPECT_FALSE(status) << script;
    return status ? "" : without_folder(to_string(status.errors()));
  }
  void choose(const std::string& name) {
    const Status status = live_.choose(scene_, name);
    EXPECT_TRUE(status) << to_string(status.errors());
  }
  /// The names of what is to be seen, in the order of the scene.
  std::string seen() const {
    std::string names;
    for (const Object& object : scene_.objects)
      if (object.is_visible) names += (names.empty() ? "" : " ") + object.name;
    return names;
  }
  const Object& object(const std::string& name) const {
    for (const Object& each : scene_.objects)
      if (each.name == name && each.is_visible) return each;
    ADD_FAILURE() << "no object " << name;
    return scene_.objects.front();
  }

  Scene scene_;
  LiveScene live_;
};

constexpr const char* square =
    "sun(elevation_deg=50)\n"
    "group(name=rows, position=\"0 10 0\") {\n"
    "  model(name=stone, file=\"small.glb\")\n"
    "  model(name=trees, file=\"small.glb\", visible=0, position=\"1 2 3\")\n"
    "}\n"
    "camera(name=eye)\n"
    "scenario(name=oranges, title=\"Orange trees\") {\n"
    "  override(of=stone, visible=0) override(of=trees, visible=1)\n"
    "}\n"
    "scenario(name=oaks, extends=oranges) {\n"
    "  override(of=trees, file=\"large.glb\", position=\"5 0 0\")\n"
    "  override(of=\"%sun\", elevation_deg=90) override(of=eye, fov_deg=90)\n"
    "  model(name=bench, file=\"small.glb\") group() { model(name=lamp, file=\"small.glb\") }\n"
    "}\n";

TEST_F(LiveSceneTest, AScenarioChangesTheSceneAndGivesItBack) {
  load(square);
  ASSERT_EQ(live_.scenarios().size(), 2u);
  EXPECT_EQ(live_.scenarios()[0]->text("title"), "Orange trees");
  EXPECT_EQ(seen(), "stone");
  const Scene base = scene_;
  for (int round = 0; round < 2; ++round) {
    choose("oranges");
    EXPECT_EQ(seen(), "trees");
    EXPECT_EQ(glm::vec3(object("trees").world_from_model[3]), glm::vec3(1, 12, 3));
    choose("oaks");
    EXPECT_EQ(live_.scenario(), "oaks");
    EXPECT_TRUE(holds(seen(), "trees") && holds(seen(), "bench") && holds(seen(), "lamp")) << seen();
    EXPECT_FALSE(holds(seen(), "stone"));
    EXPECT_EQ(glm::vec3(object("trees").world_from_model[3]), glm::vec3(5, 10, 0));
    EXPECT_NEAR(scene_.sun.direction_to_sun.z, 1.0f, 1e-6f);
    EXPECT_NEAR(std::tan(scene_.cameras.at(0).camera.vertical_fov / 2), 9.0f / 16.0f, 1e-5f);
    choose("base");
    EXPECT_EQ(live_.scenario(), "");
    EXPECT_EQ(seen(), "stone");
    EXPECT_EQ(scene_.sun.direction_to_sun, base.sun.direction_to_sun);
    EXPECT_EQ(scene_.cameras.at(0).camera.vertical_fov, base.cameras.at(0).camera.vertical_fov);
  }
}

TEST_F(LiveSceneTest, ChoosingLoadsNothing) {
  load(square);
  const std::size_t objects = scene_.objects.size();
  std::filesystem::remove(folder_.path() / "large.glb");
  std::filesystem::remove(folder_.path() / "small.glb");
  for (const char* name : {"oaks", "", "oranges", "oaks"}) {
    choose(name);
    EXPECT_EQ(scene_.objects.size(), objects) << "every place was made when the scene was loaded";
  }
}

TEST_F(LiveSceneTest, ASceneMayBeginWithAScenario) {
  load(std::string(square) + "scenario(name=empty, chosen=1) { override(of=rows, visible=0) }");
  EXPECT_EQ(live_.scenario(), "empty");
  EXPECT_EQ(seen(), "");
  choose("oranges");
  EXPECT_EQ(seen(), "trees");
  EXPECT_TRUE(holds(errors_of("scenario(name=a, chosen=1) { }\nscenario(name=b, chosen=1) { }"),
                    "scene.xp:2:25: the scene begins with scenario \"a\" already"));
}

TEST_F(LiveSceneTest, WhatWasTiedToMessagesStaysThroughAScenario) {
  load(std::string(square) + "model(name=kiosk, file=\"small.glb\")");
  const Node& kiosk = *live_.find("kiosk");
  live_.set(kiosk, "position", glm::vec3(7, 7, 7));
  EXPECT_TRUE(live_.refresh(scene_).empty());
  choose("oaks");
  choose("");
  EXPECT_EQ(glm::vec3(object("kiosk").world_from_model[3]), glm::vec3(7, 7, 7));
}

TEST_F(LiveSceneTest, TrafficIsHiddenAndRoadsStay) {
  load(
      "road(path=\"0 0, 100 0\")\ntraffic(vehicles=3) { model(file=\"small.glb\") }\n"
      "scenario(name=calm) { override(of=\"%traffic\", visible=0) }");
  const std::size_t lanes = scene_.roads.lanes.size();
  choose("calm");
  EXPECT_FALSE(scene_.data<traffic::TrafficDemand>().is_visible);
  EXPECT_EQ(scene_.data<traffic::TrafficDemand>().models.size(), 1u);
  EXPECT_EQ(scene_.roads.lanes.size(), lanes);
  choose("");
  EXPECT_TRUE(scene_.data<traffic::TrafficDemand>().is_visible);
}

TEST_F(LiveSceneTest, WhatTheCommandLineSaysHoldsInEveryScenario) {
  load(
      "exposure(value=2)\nscenario(name=dark) { override(of=\"%exposure\", value=0.5) }\n"
      "scenario(name=other) { model(name=kiosk, file=\"small.glb\") }");
  const Node& exposure = live_.unique_node("exposure");
  EXPECT_EQ(&exposure, live_.find("%exposure")) << "the script has one";
  ASSERT_TRUE(live_.hold(exposure, "value", "3"));
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(scene_.exposure, 3.0f);
  for (const char* scenario : {"dark", "other", ""}) {
    choose(scenario);
    EXPECT_EQ(scene_.exposure, 3.0f) << scenario;
  }
  const Status refused = live_.hold(exposure, "value", "bright");
  ASSERT_FALSE(refused);
  EXPECT_TRUE(holds(to_string(refused.errors()), "expected a number"));
  choose("dark");
  EXPECT_EQ(scene_.exposure, 3.0f);
}

TEST_F(LiveSceneTest, ANodeThatTheScriptLacksCanBeSet) {
  load("camera(name=eye)");
  EXPECT_EQ(live_.find("%air"), nullptr);
  live_.set(live_.unique_node("air"), "haze_per_m", 0.25);
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(scene_.haze_per_m, 0.25f);
  EXPECT_EQ(&live_.unique_node("air"), live_.find("%air")) << "it is made once";
}

TEST_F(LiveSceneTest, OverridesOfWhatIsNotThereAreReportedWithTheirPlaces) {
  const std::string errors = errors_of(std::string(square) +
                                       "road(name=street, path=\"0 0, 100 0\")\n"
                                       "scenario(name=a) {\n"
                                       "  override(of=stoen, visible=0)\n"
                                       "  override(of=stone, visibel=0)\n"
                                       "  override(of=stone, position=\"1 2\")\n"
                                       "  override(of=\"%exposure\", value=2)\n"
                                       "  override(of=street, lanes=2)\n"
                                       "  override(of=stone, file=\"none.glb\")\n"
                                       "}\n"
                                       "scenario(name=b, extends=oakes) { }\n"
                                       "scenario(name=oaks) { }\n");
  for (const char* expected :
       {"17:15: of=\"stoen\": no node of the scene has this name; did you mean \"stone\"?",
        "18:22: model \"stone\" has no attribute \"visibel\"; did you mean \"visible\"?",
        "19:31: position=\"1 2\": expected three numbers",
        "20:15: of=\"%exposure\": the scene has no exposure node",
        "21:23: road \"street\" is laid out once: its \"lanes\" is the same in all scenarios", "22:27:",
        "none.glb", "24:26: extends=\"oakes\": no node of the scene has this name; did you mean \"oaks\"?",
        "25:15: the name \"oaks\" is taken"})
    EXPECT_TRUE(holds(errors, expected)) << expected << "\nin\n" << errors;
  EXPECT_TRUE(
      holds(errors_of("scenario(name=a, extends=b) { }\nscenario(name=b, extends=a) { }"), "in a circle"));
  const auto chain_of = [](int length) {
    std::string chain = "scenario(name=s0) { }\n";
    for (int i = 1; i <= length; ++i)
      chain += "scenario(name=s" + std::to_string(i) + ", extends=s" + std::to_string(i - 1) + ") { }\n";
    return chain;
  };
  load(chain_of(256));
  const std::string too_long = errors_of(chain_of(5000));
  EXPECT_TRUE(holds(too_long, "258:29: scenario \"s257\" extends one that extends one")) << too_long;
  EXPECT_EQ(std::ranges::count(too_long, '\n'), 1) << too_long;
  load(square);
  EXPECT_TRUE(holds(to_string(live_.choose(scene_, "oack").errors()), "did you mean \"oaks\"?"));
}

/// A node type of a later part: the thesis's shadow map, as appendix A.3 gives its messages.
TEST_F(LiveSceneTest, WhatASceneHasOnceDoesNotStandInAScenario) {
  const std::string errors =
      errors_of("scenario(name=a) {\n  group() {\n    road(path=\"0 0, 100 0\")\n    sun()\n  }\n}\n");
  for (const char* expected :
       {"3:5: a road is laid out once, for all scenarios", "4:5: a scene has one sun", "of=\"%sun\""})
    EXPECT_TRUE(holds(errors, expected)) << expected << "\nin\n" << errors;
}

TEST_F(LiveSceneTest, AScenarioPaintsAModelAgain) {
  load(
      "model(name=house, file=\"small.glb\") { material(name=paint, colour=\"1 0 0\", roughness=0.5) }\n"
      "model(name=shed, file=\"small.glb\") { material(colour=\"1 0 0\", roughness=0.5) }\n"
      "scenario(name=green) { override(of=paint, colour=\"0 1 0\") }\n"
      "scenario(name=dull) { override(of=paint, roughness=1) override(of=house, position=\"5 0 0\") }\n");
  const auto material = [&](const std::string& name) { return object(name).model->materials.back(); };
  EXPECT_EQ(material("house").base_colour, glm::vec3(1, 0, 0));
  const std::size_t objects = scene_.objects.size();
  choose("green");
  EXPECT_EQ(material("house").base_colour, glm::vec3(0, 1, 0));
  EXPECT_EQ(material("shed").base_colour, glm::vec3(1, 0, 0)) << "the shed's material is another node";
  choose("dull");
  EXPECT_EQ(material("house").base_colour, glm::vec3(1, 0, 0));
  EXPECT_EQ(material("house").roughness, 1.0f);
  EXPECT_EQ(object("house").world_from_model[3].x, 5.0f);
  choose("");
  EXPECT_EQ(material("house").roughness, 0.5f);
  EXPECT_EQ(object("house").world_from_model[3].x, 0.0f);
  EXPECT_EQ(seen(), "house shed");
  EXPECT_EQ(scene_.objects.size(), objects) << "scenarios are prepared: choosing one adds nothing";
}

TEST_F(LiveSceneTest, AKindOfVehicleStaysAsItIs) {
  load("road(path=\"0 0, 100 0\")\ntraffic(vehicles=0) { model(file=\"small.glb\") }\n");
  const Node& kind = live_.find("%traffic")->children.front();
  live_.set(kind, "scale", 2.0);
  const Errors errors = live_.refresh(scene_);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_TRUE(holds(errors[0].message, "part of the node around it"));
  EXPECT_EQ(kind.number("scale"), 1.0);
}

TEST(Messages, TheShadowMapOfTheThesisUnderstandsBothSpellings) {
  NodeSchema schema{.type = "xpShadowMap",
                    .messages = {{"spot", "", {attribute::flag("on", "").required()}},
                                 {"lightPosition", "", {attribute::vec3("at", "").required()}},
                                 {"lightAngle", "", {attribute::number("deg", "").required()}}}};
  EXPECT_EQ(std::get<bool>(parse_message(schema, "spot on", {})->arguments.at(0)), true);
  EXPECT_EQ(std::get<bool>(parse_message(schema, "spot off", {})->arguments.at(0)), false);
  for (const char* text : {"lightPosition 0 0 -200", "lightposition  0 0 -200 "})
    EXPECT_EQ(std::get<glm::vec3>(parse_message(schema, text, {})->arguments.at(0)), glm::vec3(0, 0, -200));
  EXPECT_EQ(std::get<double>(parse_message(schema, "lightAngle 45.0", {})->arguments.at(0)), 45.0);
  for (const char* text :
       {"spot", "spot maybe", "spot on off", "lightPosition 0 0", "", "lightAngle", "lightDirection 1"})
    EXPECT_FALSE(parse_message(schema, text, {})) << text;
}

/// Sends a message to a node, as a panel does.
void tell(LiveScene& live, const std::string& node, const std::string& text) {
  const Result<Message> message = parse_message(*live.find(node)->schema, text, {});
  ASSERT_TRUE(message) << to_string(message.errors());
  EXPECT_TRUE(live.receive(*live.find(node), *message)) << text;
}

TEST_F(LiveSceneTest, AnAttributeTakesThePlaceOfThoseThatItReplaces) {
  load("sun(direction=\"1 0 1\")\ncamera(name=eye, position=\"0 0 2\", heading_deg=90, pitch_deg=10)\n");
  tell(live_, "%sun", "elevation_deg 90");
  tell(live_, "eye", "target 0 10 2");
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_FALSE(live_.find("%sun")->gives("direction"));
  EXPECT_NEAR(scene_.sun.direction_to_sun.z, 1.0f, 1e-6f);
  EXPECT_FALSE(live_.find("eye")->gives("heading_deg"));
  EXPECT_NEAR(scene_.cameras[0].camera.forward_in_world().y, 1.0f, 1e-6f);

  tell(live_, "%sun", "direction 0 1 0");
  tell(live_, "eye", "heading_deg 90");
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_NEAR(scene_.sun.direction_to_sun.y, 1.0f, 1e-6f);
  EXPECT_NEAR(scene_.cameras[0].camera.forward_in_world().x, 1.0f, 1e-6f);
}

TEST_F(LiveSceneTest, ANodeThatCannotBeBuiltKeepsWhatItWas) {
  load("camera(name=eye, position=\"0 0 2\", target=\"0 10 2\")\n");
  tell(live_, "eye", "target 0 0 2");
  const Errors errors = live_.refresh(scene_);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_TRUE(holds(errors[0].message, "the target lies in the eye")) << errors[0].message;
  EXPECT_EQ(live_.find("eye")->vec3("target"), glm::vec3(0, 10, 2));
  EXPECT_NEAR(scene_.cameras[0].camera.forward_in_world().y, 1.0f, 1e-6f);

  tell(live_, "eye", "position 0 0 3");
  EXPECT_TRUE(live_.refresh(scene_).empty()) << "later changes are not held up";
}

TEST_F(LiveSceneTest, TheSkyTurnsAndAScenarioGivesAnother) {
  for (const float light : {0.25f, 0.5f})
    EXPECT_TRUE(write_image(folder_.path() / fmt::format("{}.exr", light), ImageF(4, 2, 3, light)));
  load(
      "sky(file=\"0.25.exr\")\n"
      "scenario(name=noon) { override(of=\"%sky\", file=\"0.5.exr\", intensity=3) }\n");
  tell(live_, "%sky", "heading_deg 90");
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_NEAR(scene_.sky.heading, glm::half_pi<float>(), 1e-6f);
  EXPECT_EQ(scene_.sky.picture.at(0, 0)[0], 0.25f);
  choose("noon");
  EXPECT_EQ(scene_.sky.picture.at(0, 0)[0], 0.5f);
  EXPECT_EQ(scene_.sky.intensity, 3.0f);
  choose("");
  EXPECT_EQ(scene_.sky.picture.at(0, 0)[0], 0.25f);
  EXPECT_EQ(scene_.sky.intensity, 1.0f);
}

}  // namespace
}  // namespace parvis::scene
