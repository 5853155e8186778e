// terrain_plane: ground for a place that brings none.
#include "places/dressing/nodes_terrain.h"

#include "base/content_hash.h"
#include "land/roads/road_data.h"
#include "places/dressing/ground_cover.h"
#include "places/dressing/terrain_plane.h"
#include "scene/data/surroundings.h"
#include "scene/script/scene_builder.h"

namespace parvis::dressing {
namespace {

/// The terrain that a script asks for.
struct PlannedTerrain {
  static constexpr std::string_view name = "dressing.planned_terrain";
  static constexpr scene::DataRole role = scene::DataRole::settings;  // the terrain is among the objects
  bool is_wanted = false;
  TerrainLook look;

  void hash(ContentHash& hash) const { hash.add(is_wanted); }
};

scene::NodeSchema terrain_plane_schema() {
  return {.type = "terrain_plane",
          .help =
              "Ground where the scene's models bring none: between buildings, at the heights of their feet, "
              "of roads and of the ground that is there, and from the place to the horizon.",
          .attributes = {{.name = "surface",
                          .type = scene::AttributeType::choice,
                          .help = "what lies near buildings",
                          .fallback = "paving",
                          .choices = ground_covers()},
                         {.name = "beyond",
                          .type = scene::AttributeType::choice,
                          .help = "what lies elsewhere",
                          .fallback = "lawn",
                          .choices = ground_covers()}},
          .example = "terrain_plane(surface=\"paving\", beyond=\"lawn\")",
          .is_unique = true,
          .is_laid_out_once = true};
}

void build_terrain_plane(const scene::Node& node, scene::SceneBuilder& builder) {
  builder.scene.data<PlannedTerrain>() = {true, {node.text("surface"), node.text("beyond")}};
}

void finish_terrain(scene::SceneBuilder& builder) {
  constexpr float margin_m = 60.0f;
  const PlannedTerrain planned = builder.scene.data<PlannedTerrain>();
  if (!planned.is_wanted || !builder.errors().empty()) return;
  std::vector<scene::Road> roads;
  for (const scene::PlannedRoad& road : builder.scene.items<scene::PlannedRoad>()) roads.push_back(road.road);
  const scene::PlaceHeights place(builder.scene, roads, margin_m);
  const auto add = [&](scene::Model model) {
    if (model.parts.empty()) return std::shared_ptr<const scene::Model>();
    scene::Object object;
    object.name = model.name;
    object.model = std::make_shared<const scene::Model>(std::move(model));
    builder.add(object);
    return object.model;
  };
  add(near_terrain(place, planned.look));
  if (const auto around = add(land_around(place, planned.look))) builder.add(scene::Surroundings{around});
}

}  // namespace

void add_terrain_nodes(scene::NodeRegistry& registry) {
  registry.add(terrain_plane_schema(), build_terrain_plane);
  registry.add_finish_step(finish_terrain);
}

}  // namespace parvis::dressing
