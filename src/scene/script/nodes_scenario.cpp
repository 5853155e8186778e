// scenario, override: named states of a scene.
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/scene_builder.h"
#include "scene/script/script_nodes.h"

namespace parvis::scene {
namespace {

using namespace attribute;

NodeSchema scenario_schema() {
  return {
      .type = "scenario",
      .help =
          "A state of the scene: attributes of other nodes as they are while it is chosen, and nodes "
          "that stand "
          "only in it. One scenario is chosen at a time, or none: that is the base scene.",
      .attributes = {text("name", "what parvis render --scenario takes").required(),
                     text("title", "what people call it"),
                     reference("extends", "a scenario that comes first: this one changes what that one gives",
                               {"scenario"}),
                     flag("chosen", "the scene begins with it").by_default("0")},
      .example =
          "group(name=\"stone\") { }\n"
          "group(name=\"oaks\", visible=0) { }\n"
          "scenario(name=\"green\", title=\"Two rows of oaks\") {\n"
          "  override(of=\"stone\", visible=0)\n"
          "  override(of=\"oaks\", visible=1, position=\"0 2 0\")\n"
          "}",
      .messages = {{"choose", "makes it the scene's state", {}}}};
}

NodeSchema override_schema() {
  return {.type = "override",
          .help =
              "Attributes of a node while the scenario is chosen: beside of=, any that the node's own type "
              "has (of what "
              "is laid out once, roads and traffic, only visible=). Materials of models are nodes, too.",
          .attributes = {reference("of", "the node; %TYPE for the one node of a type, as %sun").required()},
          .stands_in = {"scenario"},
          .example =
              "sun(elevation_deg=50)\n"
              "scenario(name=\"evening\") {\n"
              "  override(of=\"%sun\", elevation_deg=12)\n"
              "}",
          .takes_attributes_of = "of"};
}

/// A node that a scene has once would be there in all scenarios.
void refuse_what_stands_once(const Nodes& nodes, const std::string& scenario, SceneBuilder& builder) {
  for (const Node& node : nodes) {
    const std::string& type = node.schema->type;
    if (node.schema->is_laid_out_once)
      builder.fail(error_at(node.where,
                            "a {} is laid out once, for all scenarios; it does not stand in \"{}\"", type,
                            scenario));
    else if (node.schema->is_unique)
      builder.fail(error_at(node.where,
                            "a scene has one {}; in scenario \"{}\" change it by override(of=\"%{}\", ...)",
                            type, scenario, type));
    refuse_what_stands_once(node.children, scenario, builder);
  }
}

void build_scenario(const Node& node, SceneBuilder& builder) {
  refuse_what_stands_once(node.children, node.text("name"), builder);
  builder.build(node.children, glm::mat4(1.0f), node.flag("chosen"));
}

}  // namespace

void add_scenario_nodes(NodeRegistry& registry) {
  registry.add(scenario_schema(), build_scenario);
  registry.add(override_schema(), [](const Node&, SceneBuilder&) {});  // its scenario reads it
}

}  // namespace parvis::scene
