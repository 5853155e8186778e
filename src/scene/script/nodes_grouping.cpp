// include, group: nodes that hold others.
#include "scene/script/attribute.h"
#include "scene/script/node_registry.h"
#include "scene/script/placement.h"
#include "scene/script/scene_builder.h"
#include "scene/script/script_nodes.h"

namespace parvis::scene {
namespace {

using namespace attribute;

NodeSchema include_schema() {
  return {.type = include_type,
          .help = "The nodes of another script, as if they were written here.",
          .attributes = {file("file", "a scene script").required()},
          .stands_in = {top_level, "group", "scenario"},
          .example = "include(file=\"evening_light.xp\")"};
}

NodeSchema group_schema() {
  NodeSchema schema{.type = "group",
                    .help = "Nodes that are placed together.",
                    .attributes = placement_attributes(),
                    .stands_in = {top_level, "group", "scenario"},
                    .example =
                        "group(position=\"120 40 0\", heading_deg=30) {\n"
                        "  camera(name=\"corner\", position=\"0 0 1.6\", target=\"10 0 2\")\n"
                        "}"};
  schema.attributes.insert(schema.attributes.begin(), text("name", "by which other nodes refer to it"));
  schema.attributes.push_back(visible_attribute());
  const AttributeSchema one = child("node", "which").required();
  AttributeSchema any = one;
  any.is_required = false;
  schema.messages = {{"show", "makes the group, or a node inside it, visible", {any}},
                     {"hide", "makes the group, or a node inside it, invisible", {any}},
                     {"toggle", "shows what is hidden, hides what is shown", {any}},
                     {"only", "shows one of its nodes and hides those beside it", {one}}};
  return schema;
}

}  // namespace

void add_grouping_nodes(NodeRegistry& registry) {
  registry.add(include_schema(),
               [](const Node& node, SceneBuilder& builder) { builder.build(node.children); });
  registry.add(group_schema(), [](const Node& node, SceneBuilder& builder) {
    builder.build(node.children, placement(node), node.flag("visible"));
  });
}

}  // namespace parvis::scene
