#include "scene/script/node_text.h"

#include "scene/script/script_format.h"

namespace parvis::scene {

ScriptNode written_node(const Node& node) {
  ScriptNode result;
  result.type = node.schema->type;
  for (const auto* attributes : {&node.attributes, &node.overrides})
    for (const NodeAttribute& attribute : *attributes) {
      ScriptAttribute& given = result.attributes.emplace_back();
      given.name = attribute.schema->name, given.value = written(attribute);
    }
  for (const Node& child : node.children) result.children.push_back(written_node(child));
  return result;
}

std::string script_of(const Nodes& nodes) {
  ScriptNode file;
  for (const Node& node : nodes) file.children.push_back(written_node(node));
  return format_script(file);
}

}  // namespace parvis::scene
