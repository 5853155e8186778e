// litWindows: light behind some of the windows that `facades` has painted.
#include "places/dressing/nodes_lit_windows.h"

#include <map>
#include <memory>
#include <optional>

#include "places/dressing/lit_windows.h"
#include "scene/script/attribute.h"
#include "scene/script/scene_builder.h"

namespace parvis::dressing {
namespace {

scene::NodeSchema lit_windows_schema() {
  using namespace scene::attribute;
  return {
      .type = "litWindows",
      .help =
          "Light behind some of the windows of a model whose walls are facades: an object \"lit windows\", "
          "to be seen while a lamp burns that shows it. Stands after the model.",
      .attributes = {reference("of", "the model", {"model"}).required()},
      .example =
          "model(name=\"quarter\", file=\"quarter.city.json\") {\n  facades()\n}\n"
          "litWindows(of=\"quarter\")\n"
          "lamp(position=\"0 0 5\", flux_lm=5000, shows=\"lit windows\")",
      .is_laid_out_once = true};
}

void build_lit_windows(const scene::Node& node, scene::SceneBuilder& builder) {
  std::map<const scene::Model*, std::shared_ptr<const scene::Model>> made;  // objects share their models
  bool has_windows = false;
  for (const int index : builder.objects_of(node.text("of"))) {
    const scene::Object of = builder.scene.objects[std::size_t(index)];
    auto [known, is_new] = made.try_emplace(of.model.get());
    if (is_new)
      if (std::optional<scene::Model> lit = lit_windows(*of.model))
        known->second = std::make_shared<const scene::Model>(*std::move(lit));
    if (!known->second) continue;
    has_windows = true;
    if (known->second->parts.empty()) continue;
    scene::Object object;
    object.name = "lit windows";
    object.model = known->second;
    object.world_from_model = of.world_from_model;
    object.is_visible = false;
    builder.add(object);
  }
  if (!has_windows)
    builder.warn(error_at(node.where_of("of"),
                          "litWindows: \"{}\" has no windows of facades; give its model facades(...)",
                          node.text("of")));
}

}  // namespace

void add_lit_windows_node(scene::NodeRegistry& registry) {
  registry.add(lit_windows_schema(), build_lit_windows);
}

}  // namespace parvis::dressing
