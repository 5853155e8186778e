// facades: for buildings that are bare volumes.
#include "city/city_nodes.h"

#include "city/facades.h"
#include "scene/scene_builder.h"

namespace parvis::city {
namespace {

scene::NodeSchema facades_schema() {
  return {
      .type = "facades",
      .help =
          "Brick walls with windows for a city model whose buildings are bare volumes. Materials that later "
          "nodes "
          "can change: \"facade\" and \"brick wall\".",
      .attributes = {{.name = "target",
                      .help =
                          "name of objects, nodes or materials of the file; * and ? stand for any text and "
                          "any character",
                      .fallback = "*"}},
      .stands_in = {"model"},
      .example =
          "model(file=\"quarter.city.json\") {\n"
          "  facades(target=\"WallSurface\")\n"
          "}"};
}

void build_facades(const scene::Node& node, scene::Model& model, scene::SceneBuilder& builder) {
  const std::string target = node.text("target");
  if (add_facades(model, target) == 0)
    builder.warn(error_at(node.where_of("target"), "facades: nothing that matches \"{}\" has walls", target));
}

}  // namespace

void add_city_nodes(scene::NodeRegistry& registry) { registry.add_change(facades_schema(), build_facades); }

}  // namespace parvis::city
