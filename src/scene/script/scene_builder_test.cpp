// What a room brings to scripts: here a test room with a fountain, which has jets as its parts, and a step
// that finishes the scene. Nothing outside this file knows them.
#include "scene/script/scene_builder.h"

#include <gtest/gtest.h>

#include "scene/data/test_scene.h"
#include "scene/script/attribute.h"
#include "scene/script/live_scene.h"
#include "scene/script/placement.h"
#include "scene/script/room.h"
#include "scene/script/test_script.h"

namespace parvis::scene {
namespace {

using namespace attribute;

/// An item: one jet of a fountain, in the world.
struct Jet {
  static constexpr std::string_view name = "test.jet";
  static constexpr DataRole role = DataRole::static_content;
  glm::vec3 foot;
  float height_m;

  void hash(ContentHash& hash) const {
    hash.add(foot);
    hash.add(height_m);
  }
};

/// A value: what the finish step has counted.
struct WaterNeed {
  static constexpr std::string_view name = "test.water_need";
  static constexpr DataRole role = DataRole::settings;
  float metres_of_jets = 0.0f;

  void hash(ContentHash& hash) const { hash.add(metres_of_jets); }
};

/// An item: the pavement around a fountain's basin, of as many slabs as were laid before.
struct Slab {
  static constexpr std::string_view name = "test.slab";
  static constexpr DataRole role = DataRole::static_content;
  float x;
  int number;

  void hash(ContentHash& hash) const { hash.add(x), hash.add(number); }
};

/// A step for all basins of the builder's scene.
void pave(SceneBuilder& builder) {
  for (std::size_t i = 0; i < builder.scene.objects.size(); ++i) {
    const float x = builder.scene.objects[i].world_from_model[3].x;
    builder.add_all_for(i, std::vector<Slab>{{x, 0}, {x, 1}});
    if (x > 1000.0f) builder.fail(error("no pavement there"));
  }
}

NodeSchema jet_schema() {
  return {.type = "jet",
          .help = "One jet.",
          .attributes = {number("height", "of the water").between(0, 9).by_default("2").live()},
          .stands_in = {"fountain"},
          .example = "fountain() { jet(height=3) }"};
}

NodeSchema fountain_schema() {
  NodeSchema schema{.type = "fountain",
                    .help = "Water.",
                    .attributes = placement_attributes(),
                    .example = "fountain()",
                    .messages = {{"rinse", "empties the basin", {}}}};
  schema.attributes.insert(schema.attributes.begin(), {.name = "name", .help = "by which others call it"});
  schema.attributes.push_back(visible_attribute());
  return schema;
}

void build_fountain(const Node& node, SceneBuilder& builder) {
  const glm::mat4 world_from_fountain = builder.world_from_parent() * placement(node);
  Object basin;
  basin.name = node.text("name");
  basin.model = builder.shared_model("basin", [] { return model_of(ground(1.0f), {}); });
  basin.world_from_model = world_from_fountain;
  basin.is_visible = builder.is_visible() && node.flag("visible");
  builder.add(std::move(basin));
  for (const Node& jet : node.children) {
    if (jet.number("height") == 0.0) return builder.fail(error_at(jet.where, "a jet without water"));
    builder.add(Jet{glm::vec3(world_from_fountain[3]), float(jet.number("height"))});
  }
}

void furnish(House& house) {
  NodeRegistry& registry = house.get<NodeRegistry>();
  registry.add(fountain_schema(), build_fountain);
  registry.add_part(jet_schema());
  registry.add_finish_step([](SceneBuilder& builder) {
    for (const Jet& jet : builder.scene.items<Jet>())
      builder.scene.data<WaterNeed>().metres_of_jets += jet.height_m;
    if (builder.scene.data<WaterNeed>().metres_of_jets > 100.0f) builder.fail(error("not so much water"));
  });
  registry.add_finish_step(pave);
  registry.add_rebuild_step(pave);
}

class SceneBuilderTest : public ScriptTest<> {
 protected:
  SceneBuilderTest() { script::furnish(house_), furnish(house_); }

  void load(const std::string& script) {
    Result<LoadedScene> loaded = ScriptTest::load(script);
    ASSERT_TRUE(loaded) << to_string(loaded.errors());
    scene_ = std::move(loaded->scene);
    live_ = LiveScene(std::move(loaded->script));
  }
  /// Heights of all jets, in the scene's order.
  std::vector<float> heights() const {
    std::vector<float> all;
    for (const Jet& jet : scene_.items<Jet>()) all.push_back(jet.height_m);
    return all;
  }

  Scene scene_;
  LiveScene live_;
};

const std::string three =
    "fountain(name=a, position=\"1 0 0\") { jet(height=1) jet(height=2) }\n"
    "group(name=g, position=\"10 0 0\") { fountain(name=b) { jet(height=3) } }\n"
    "fountain(name=c) { jet(height=4) }\n";

TEST_F(SceneBuilderTest, ItemsStandInTheOrderOfTheScript) {
  load(three);
  EXPECT_EQ(heights(), (std::vector{1.0f, 2.0f, 3.0f, 4.0f}));
  EXPECT_EQ(scene_.objects.size(), 3u);
  EXPECT_EQ(scene_.items<Jet>()[2].foot, glm::vec3(10, 0, 0));
}

TEST_F(SceneBuilderTest, AChangeReplacesExactlyWhatTheNodeMade) {
  load(three);
  live_.set(*live_.find("g"), "position", glm::vec3(20, 0, 0));
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(heights(), (std::vector{1.0f, 2.0f, 3.0f, 4.0f}));
  EXPECT_EQ(scene_.items<Jet>()[2].foot, glm::vec3(20, 0, 0));
  EXPECT_EQ(scene_.items<Jet>()[0].foot, glm::vec3(1, 0, 0));
  ASSERT_EQ(scene_.objects.size(), 3u);
  EXPECT_EQ(scene_.objects[1].world_from_model[3].x, 20.0f);
}

TEST_F(SceneBuilderTest, WhatAStepGaveToAnObjectIsReplacedWithIt) {
  load(three);
  const auto places = [&] {
    std::vector<float> xs;
    for (std::size_t i = 0; i < scene_.items<Slab>().size(); ++i) {
      EXPECT_EQ(scene_.items<Slab>()[i].number, int(i % 2));
      xs.push_back(scene_.items<Slab>()[i].x);
    }
    return xs;
  };
  EXPECT_EQ(places(), (std::vector{1.0f, 1.0f, 10.0f, 10.0f, 0.0f, 0.0f}));
  live_.set(*live_.find("g"), "position", glm::vec3(20, 0, 0));
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(places(), (std::vector{1.0f, 1.0f, 20.0f, 20.0f, 0.0f, 0.0f}));
  live_.set(*live_.find("a"), "position", glm::vec3(2000, 0, 0));
  EXPECT_EQ(live_.refresh(scene_).size(), 1u);
  EXPECT_EQ(places(), (std::vector{1.0f, 1.0f, 20.0f, 20.0f, 0.0f, 0.0f})) << "a step that fails";
}

TEST_F(SceneBuilderTest, AChangedPartBuildsTheNodeAroundItAgain) {
  load(three);
  live_.set(*std::next(live_.find("a")->children.begin()), "height", 7.0);
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(heights(), (std::vector{1.0f, 7.0f, 3.0f, 4.0f}));
}

TEST_F(SceneBuilderTest, WhatCannotBeRebuiltStaysAsItWas) {
  load(three);
  live_.set(*std::next(live_.find("a")->children.begin()), "height", 0.0);
  const Errors errors = live_.refresh(scene_);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("without water"), std::string::npos);
  EXPECT_EQ(heights(), (std::vector{1.0f, 2.0f, 3.0f, 4.0f}));
  EXPECT_EQ(std::next(live_.find("a")->children.begin())->number("height"), 2.0);
}

TEST_F(SceneBuilderTest, AValueThatCannotBeBuiltLeavesTheOthersOfItsMoment) {
  load(three);
  const Node& fountain = *live_.find("a");
  live_.set(fountain.children.back(), "height", 7.0);
  live_.set(fountain.children.front(), "height", 0.0);
  live_.set(fountain, "position", glm::vec3(4, 0, 0));
  const Errors errors = live_.refresh(scene_);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_NE(errors[0].message.find("without water"), std::string::npos);
  EXPECT_EQ(heights(), (std::vector{1.0f, 7.0f, 3.0f, 4.0f}));
  EXPECT_EQ(fountain.children.front().number("height"), 1.0);
  EXPECT_EQ(fountain.vec3("position"), glm::vec3(4, 0, 0));
  EXPECT_TRUE(live_.refresh(scene_).empty()) << "nothing is left to be tried again";
}

TEST_F(SceneBuilderTest, FinishStepsSeeTheWholeSceneOnce) {
  load(three);
  EXPECT_EQ(scene_.data<WaterNeed>().metres_of_jets, 10.0f);
  live_.set(*live_.find("c"), "position", glm::vec3(1));
  EXPECT_TRUE(live_.refresh(scene_).empty());
  EXPECT_EQ(scene_.data<WaterNeed>().metres_of_jets, 10.0f);
  std::string much = "fountain() {";
  for (int i = 0; i < 12; ++i) much += " jet(height=9)";
  const Result<LoadedScene> refused = ScriptTest::load(much + " }");
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.errors()).find("not so much water"), std::string::npos);
}

TEST_F(SceneBuilderTest, ANodeStandsInAnotherRoomsNodeWhereThatRoomAllowsIt) {
  const std::string inside = "fountain() { camera(name=wet) }";
  const Result<LoadedScene> refused = ScriptTest::load(inside);
  ASSERT_FALSE(refused);
  EXPECT_NE(to_string(refused.errors()).find("camera does not stand in fountain, which takes jet"),
            std::string::npos);
  house_.get<NodeRegistry>().allow("camera", "fountain");
  EXPECT_EQ(house_.get<NodeRegistry>().children_of("fountain"), (std::vector<std::string>{"camera", "jet"}));
}

}  // namespace
}  // namespace parvis::scene
