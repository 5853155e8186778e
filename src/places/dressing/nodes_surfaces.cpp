// facades, roofs, ground, greenery: for city models that are bare volumes.
#include "places/dressing/nodes_surfaces.h"

#include "base/known_names.h"
#include "places/dressing/facades.h"
#include "places/dressing/ground_cover.h"
#include "places/dressing/roofs.h"
#include "places/dressing/town_ground.h"
#include "scene/data/model_parts.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"
#include "synthesis/place_seed.h"

namespace parvis::dressing {
namespace {

constexpr const char *wall_name = "WallSurface", *roof_name = "RoofSurface";
constexpr const char* by_density = "by_density";  // a surface of ground()

scene::AttributeSchema target_attribute() {
  using namespace scene::attribute;
  return text("target",
              "name of objects, nodes or materials of the file; * and ? stand for any text and any character")
      .by_default("*");
}

/// Walls and roofs are what a city model calls so, where nothing else is asked for: bridges and trees have
/// steep and level faces, too.
std::string target_or(const scene::Node& node, const scene::Model& model, const char* usual) {
  const bool is_usual = !node.gives("target") && !scene::matching_parts(model, usual).empty();
  return is_usual ? usual : node.text("target");
}

scene::AttributeSchema surface_attribute(const char* usual) {
  using namespace scene::attribute;
  return text("target",
              fmt::format(
                  "name of objects, nodes or materials of the file; * and ? stand for any text and any "
                  "character; without it, \"{}\" where the file has that",
                  usual))
      .by_default("*");
}

std::string example_of(const std::string& node) {
  return "model(file=\"quarter.city.json\") {\n  " + node + "\n}";
}

/// Nothing of the file answered to `target`.
void warn(scene::SceneBuilder& builder, const scene::Node& node, const scene::Model& model,
          const char* wanted) {
  builder.warn(error_at(node.where_of("target"), "{}: nothing that matches \"{}\" has {}{}",
                        node.schema->type, node.text("target"), wanted,
                        names_that_exist(node.text("target"), scene::part_names(model))));
}

scene::NodeSchema facades_schema() {
  using namespace scene::attribute;
  return {.type = "facades",
          .help =
              "Walls with doors, shops and windows for a city model whose buildings are bare volumes; by the "
              "year, "
              "use, storeys, material and colour of a building where its file says them, else bricks. Party "
              "walls "
              "stay blank, pictures and windows of the model itself are kept. Materials that later nodes can "
              "change: \"street level\", \"facade\" and \"brick wall\", \"plaster wall\" and so on.",
          .attributes = {surface_attribute(wall_name),
                         flag("openings", "0: walls alone, as of gardens and quays").by_default("1")},
          .stands_in = {"model"},
          .example = example_of("facades(target=\"WallSurface\")")};
}

void build_facades(const scene::Node& node, scene::Model& model, scene::SceneBuilder& builder) {
  if (add_facades(model, target_or(node, model, wall_name), synthesis::place_seed, node.flag("openings")) ==
      0)
    warn(builder, node, model, "walls");
}

scene::NodeSchema roofs_schema() {
  using namespace scene::attribute;
  return {
      .type = "roofs",
      .help =
          "Tiles on the sloping roofs of a city model, gravel on the flat ones, parapets and chimneys. "
          "Materials "
          "that later nodes can change: \"roof tiles\", \"flat roof\", \"roof edge\", \"chimney\", \"roof "
          "plant\".",
      .attributes = {surface_attribute(roof_name)},
      .stands_in = {"model"},
      .example = example_of("roofs(target=\"RoofSurface\")")};
}

void build_roofs(const scene::Node& node, scene::Model& model, scene::SceneBuilder& builder) {
  if (add_roofs(model, target_or(node, model, roof_name)) == 0) warn(builder, node, model, "roofs");
}

scene::NodeSchema ground_schema() {
  using namespace scene::attribute;
  std::vector<std::string> surfaces = ground_covers();
  surfaces.emplace_back(by_density);
  return {.type = "ground",
          .help = "What lies on the ground of a city model. The material has the name of the surface.",
          .attributes = {target_attribute(),
                         choice("surface",
                                "what to lay; by_density: paving where houses stand close, lawn elsewhere",
                                surfaces)
                             .by_default("paving")},
          .stands_in = {"model"},
          .example = example_of("ground(target=\"TINRelief\", surface=\"gravel\")")};
}

void build_ground(const scene::Node& node, scene::Model& model, scene::SceneBuilder& builder) {
  const std::string &target = node.text("target"), &surface = node.text("surface");
  if ((surface == by_density ? add_town_ground(model, target) : add_ground_cover(model, target, surface)) ==
      0)
    warn(builder, node, model, "ground");
}

scene::NodeSchema greenery_schema() {
  using namespace scene::attribute;
  return {.type = "greenery",
          .help =
              "Lawns and trees in place of green that was measured from the air, which stands in a model as "
              "ground "
              "pulled up to the tops of trees.",
          .attributes = {target_attribute()},
          .stands_in = {"model"},
          .example = example_of("greenery(target=\"PlantCover\")")};
}

void build_greenery(const scene::Node& node, scene::Model& model, scene::SceneBuilder& builder) {
  if (add_greenery(model, node.text("target"), synthesis::place_seed) == 0)
    warn(builder, node, model, "trees");
}

}  // namespace

void add_surface_nodes(scene::NodeRegistry& registry) {
  registry.add_change(facades_schema(), build_facades);
  registry.add_change(roofs_schema(), build_roofs);
  registry.add_change(ground_schema(), build_ground);
  registry.add_change(greenery_schema(), build_greenery);
}

}  // namespace parvis::dressing
