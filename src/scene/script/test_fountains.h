// What a room brings to scripts, for tests: fountains, which have jets as their parts, and steps that finish
// the scene. Nothing else knows them.
#pragma once

#include "base/registries.h"
#include "room_list.h"
#include "scene/data/test_scene.h"
#include "scene/script/attribute.h"
#include "scene/script/live_scene.h"
#include "scene/script/placement.h"
#include "scene/script/test_script.h"

namespace parvis::scene {

using namespace attribute;

/// An item: one jet of a fountain, in the world.
struct Jet {
  static constexpr std::string_view name = "test.jet";
  static constexpr DataRole role = DataRole::static_content;
  glm::vec3 foot;
  float height_m;

  /// Adds all members.
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

  /// Adds all members.
  void hash(ContentHash& hash) const { hash.add(metres_of_jets); }
};

/// An item: the pavement around a fountain's basin, of as many slabs as were laid before.
struct Slab {
  static constexpr std::string_view name = "test.slab";
  static constexpr DataRole role = DataRole::static_content;
  float x;
  int number;

  /// Adds all members.
  void hash(ContentHash& hash) const { hash.add(x), hash.add(number); }
};

/// A step for all basins of the builder's scene.
inline void pave(SceneBuilder& builder) {
  for (std::size_t i = 0; i < builder.scene.objects.size(); ++i) {
    const float x = builder.scene.objects[i].world_from_model[3].x;
    builder.add_all_for(i, std::vector<Slab>{{x, 0}, {x, 1}});
    if (x > 1000.0f) builder.fail(error("no pavement there"));
  }
}

/// A part of a fountain.
inline NodeSchema jet_schema() {
  return {.type = "jet",
          .help = "One jet.",
          .attributes = {number("height", "of the water").between(0, 9).by_default("2").live()},
          .stands_in = {"fountain"},
          .example = "fountain() { jet(height=3) }"};
}

/// The node of a fountain.
inline NodeSchema fountain_schema() {
  NodeSchema schema{.type = "fountain",
                    .help = "Water.",
                    .attributes = placement_attributes(),
                    .example = "fountain()",
                    .messages = {{"rinse", "empties the basin", {}}}};
  schema.attributes.insert(schema.attributes.begin(), {.name = "name", .help = "by which others call it"});
  schema.attributes.push_back(visible_attribute());
  return schema;
}

/// A basin, and an item for each jet.
inline void build_fountain(const Node& node, SceneBuilder& builder) {
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

/// Adds the nodes and steps of this file.
inline void register_fountains(Registries& registries) {
  NodeRegistry& registry = registries.get<NodeRegistry>();
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

/// Loads scripts that may hold fountains.
class FountainTest : public ScriptTest<> {
 protected:
  FountainTest() { script::register_room(registries_), register_fountains(registries_); }

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

}  // namespace parvis::scene
