// The node `plant`: what it makes, what it says of bad values, how it is changed.
#include <gtest/gtest.h>

#include "base/memory_budget.h"
#include "life/vegetation/scene_plant.h"
#include "room_list.h"
#include "scene/script/live_scene.h"
#include "scene/script/test_script.h"

namespace parvis::vegetation {
namespace {

class PlantNode : public scene::ScriptTest<> {
 protected:
  PlantNode() { script::register_room(registries_), register_room(registries_); }
};

TEST_F(PlantNode, EqualPlantsShareTheirMemory) {
  const auto loaded = load(
      "plant(kind=\"orange\", position=\"5 2 1\")\n"
      "group(position=\"1 0 0\") { plant(kind=\"orange\", height=3, length=9, visible=0) }\n"
      "plant(kind=\"orange\", seed=2)\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  const std::vector<ScenePlant>& plants = scene_plants(loaded->scene);
  ASSERT_EQ(plants.size(), 3u);
  EXPECT_EQ(plants[0].shape, plants[1].shape) << "3 m is usual, and trees have no length";
  EXPECT_NE(plants[0].shape, plants[2].shape);
  EXPECT_EQ(glm::vec3(plants[0].world_from_plant[3]), glm::vec3(5, 2, 1));
  EXPECT_FALSE(plants[1].is_visible);
}

TEST_F(PlantNode, BadValuesAreErrorsAtTheirPlace) {
  const auto names = [&](const std::string& node, const std::string& expected) {
    const std::string errors = errors_of("\n" + node + "\n");
    EXPECT_NE(errors.find("scene.xp:2:"), std::string::npos) << node << ": " << errors;
    EXPECT_NE(errors.find(expected), std::string::npos) << node << ": " << errors;
  };
  names("plant(kind=\"palm\")", "oak");
  names("plant(seed=2)", "kind");
  names("plant(kind=\"oak\", height=0.5)", "between 2 and 30 m");
  names("plant(kind=\"oak\", height=-1)", "height");
  names("plant(kind=\"oak\", height=nan)", "height");
  names("plant(kind=\"oak\", height=1e9)", "height");
  names("plant(kind=\"oak\", seed=-1)", "seed");
  names("plant(kind=\"hedge\", length=0)", "length");
  names("plant(kind=\"hedge\", length=900)", "side by side");
  names("plant(kind=\"grass\", length=100)", "400000");
}

TEST_F(PlantNode, PlantsBeyondTheMemoryAreRefused) {
  const std::uint64_t before = max_memory();
  set_max_memory(memory_in_use() + (16u << 20));
  const std::string errors = errors_of("plant(kind=\"oak\", height=20)\n");
  set_max_memory(before);
  EXPECT_NE(errors.find("share their memory"), std::string::npos) << errors;
}

TEST_F(PlantNode, IsEditedWhileTheSceneRuns) {
  auto loaded =
      load("plant(name=\"a\", kind=\"orange\")\nplant(name=\"b\", kind=\"orange\", position=\"4 0 0\")\n");
  ASSERT_TRUE(loaded) << to_string(loaded.errors());
  scene::Scene scene = std::move(loaded->scene);
  scene::LiveScene live(std::move(loaded->script));
  const auto kept = scene_plants(scene)[1].shape;
  ASSERT_TRUE(live.hold(*live.find("b"), "kind", "hedge"));
  ASSERT_TRUE(live.hold(*live.find("a"), "position", "1 2 0"));
  EXPECT_TRUE(live.refresh(scene).empty());
  const std::vector<ScenePlant>& plants = scene_plants(scene);
  ASSERT_EQ(plants.size(), 2u);
  EXPECT_EQ(plants[0].shape, kept) << "a plant that moves does not grow again";
  EXPECT_EQ(glm::vec3(plants[0].world_from_plant[3]), glm::vec3(1, 2, 0));
  EXPECT_EQ(plants[1].shape->kind().name, "hedge");
  EXPECT_EQ(plants[1].shape->recipe.height_m, 1.2f);
  ASSERT_TRUE(live.hold(*live.find("b"), "height", "20"));
  EXPECT_FALSE(live.refresh(scene).empty()) << "no hedge is 20 m high";
  EXPECT_EQ(scene_plants(scene).size(), 2u);
}

}  // namespace
}  // namespace parvis::vegetation
