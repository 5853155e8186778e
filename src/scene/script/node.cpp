#include "scene/script/node.h"

#include <cassert>

namespace parvis::scene {

const NodeAttribute* Node::find(const std::string& name) const {
  assert(schema->find(name) && "the node's schema has no such attribute");
  for (const NodeAttribute& attribute : attributes)
    if (attribute.schema->name == name) return &attribute;
  return nullptr;
}

void Node::set(const std::string& name, AttributeValue new_value) {
  const AttributeSchema* attribute = schema->find(name);
  assert(attribute && "the node's schema has no such attribute");
  std::erase_if(attributes, [&](const NodeAttribute& each) { return each.schema == attribute; });
  attributes.push_back({attribute, std::move(new_value), {}, where});
}

const FileLocation& Node::where_of(const std::string& name) const {
  const NodeAttribute* attribute = find(name);
  return attribute ? attribute->where : where;
}

template <class T>
std::optional<T> Node::value(const std::string& name) const {
  if (const NodeAttribute* attribute = find(name)) return std::get<T>(attribute->value);
  const AttributeSchema& attribute = *schema->find(name);
  if (attribute.fallback.empty() || attribute.type == AttributeType::file) return std::nullopt;
  const Result<AttributeValue> fallback = parse_value(attribute, attribute.fallback, Roots(""), {});
  assert(fallback && "the schema's default is no value of its type");
  return std::get<T>(*fallback);
}

std::string Node::text(const std::string& name) const { return value<std::string>(name).value_or(""); }
double Node::number(const std::string& name) const { return value<double>(name).value_or(0.0); }
float Node::angle(const std::string& name) const { return float(number(name)); }
long Node::integer(const std::string& name) const { return value<long>(name).value_or(0); }
bool Node::flag(const std::string& name) const { return value<bool>(name).value_or(false); }
glm::vec3 Node::vec3(const std::string& name) const {
  return value<glm::vec3>(name).value_or(glm::vec3(0.0f));
}

std::vector<glm::vec3> Node::points(const std::string& name) const {
  std::vector<glm::vec3> all;
  for (const NodeAttribute& attribute : attributes) {
    if (attribute.schema->name != name) continue;
    const auto& points = std::get<std::vector<glm::vec3>>(attribute.value);
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

std::filesystem::path Node::file(const std::string& name) const {
  return value<std::filesystem::path>(name).value_or(std::filesystem::path());
}

std::string written(const NodeAttribute& attribute) {
  return attribute.text.empty() ? written_value(*attribute.schema, attribute.value) : attribute.text;
}

const Node* find_node(const Nodes& nodes, const std::string& name) {
  for (const Node& node : nodes) {
    const bool is_named = node.schema->find("name") && node.gives("name") && node.text("name") == name;
    if (is_named || (node.schema->is_unique && name == "%" + node.schema->type)) return &node;
    if (const Node* inside = find_node(node.children, name)) return inside;
  }
  return nullptr;
}

std::string signature(const Node& node) {
  std::string text = node.schema->type + "(";
  for (const NodeAttribute& attribute : node.attributes) {
    const auto* file = std::get_if<std::filesystem::path>(&attribute.value);
    if (attribute.schema->name != "name")
      text += fmt::format("{}={:?},", attribute.schema->name, file ? file->string() : written(attribute));
  }
  text += "){";
  for (const Node& child : node.children) text += signature(child);
  return text + "}";
}

}  // namespace parvis::scene
