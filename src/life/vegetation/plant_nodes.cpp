// plant: a grown plant in a scene.
#include "base/registries.h"
#include "life/vegetation/plant_drawable.h"
#include "life/vegetation/scene_plant.h"
#include "room_list.h"
#include "scene/script/attribute.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"

namespace parvis::vegetation {
namespace {

using namespace scene::attribute;

using scene::Node, scene::SceneBuilder;

constexpr std::size_t max_plants = 50'000;

scene::NodeSchema plant_schema() {
  std::vector<std::string> kinds;
  for (const PlantKind& kind : plant_kinds()) kinds.emplace_back(kind.name);
  scene::NodeSchema schema{
      .type = "plant",
      .help =
          "A grown plant with every leaf as geometry; from afar its leaves become points and its twigs "
          "lines. "
          "Plants of one kind, height and seed share their memory. Its foot stands at position.",
      .attributes = {text("name", "by which other nodes refer to it"),
                     choice("kind", "of plant", kinds).required().live(),
                     integer("seed", "another one, another shape").between(0, 1e9).by_default("1").live(),
                     number("height", "of the plant; 0: as usual for its kind")
                         .in("m")
                         .between(0, 100)
                         .by_default("0")
                         .live(),
                     number("length", "of a hedge, and of a side of a square of grass; trees have none")
                         .in("m")
                         .between(0.1, 1000)
                         .by_default("2")
                         .live()},
      .example = "plant(kind=\"oak\", seed=3, height=8, position=\"12 -4 0\")"};
  for (scene::AttributeSchema& attribute : scene::placement_attributes())
    schema.attributes.push_back(std::move(attribute));
  schema.attributes.push_back(scene::visible_attribute());
  return schema;
}

void build_plant(const Node& node, SceneBuilder& builder) {
  PlantRecipe recipe;
  recipe.kind = find_kind(node.text("kind"));
  recipe.height_m = float(node.number("height"));
  if (recipe.height_m == 0.0f) recipe.height_m = recipe.kind->height_m;
  recipe.length_m = float(node.number("length"));
  recipe.seed = std::uint64_t(node.integer("seed"));
  if (scene_plants(builder.scene).size() >= max_plants)
    return builder.fail(
        error_at(node.where_of("kind"), "{} plants are the most that one scene has", max_plants));
  Result<std::shared_ptr<const PlantShape>> shape = shared_plant(builder.scene.data<PlantCache>(), recipe);
  if (!shape) return builder.fail(shape.errors(), node.where_of("height"));
  ScenePlant plant;
  plant.shape = *std::move(shape);
  plant.world_from_plant = builder.world_from_parent() * scene::placement(node);
  plant.is_visible = builder.is_visible() && node.flag("visible");
  builder.add(std::move(plant));
}

}  // namespace

/// How grown plants join Parvis: the node `plant`, and what draws and traces it.
void register_room(Registries& registries) {
  registries.get<scene::NodeRegistry>().add(plant_schema(), build_plant);
  registries.get<render::Drawables>().add(scene_plants_kind());
}

}  // namespace parvis::vegetation
