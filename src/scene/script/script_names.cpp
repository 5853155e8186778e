#include "scene/script/script_names.h"

#include <algorithm>

#include "base/known_names.h"
#include "scene/script/message.h"
#include "scene/script/spelling.h"

namespace parvis::scene {
namespace {

class NameResolver {
 public:
  NameResolver(const ScriptNames& names, const Roots& roots, const std::function<void(Error)>& tell)
      : names_(names), roots_(roots), tell_(tell) {}

  void know_nodes(const Nodes& nodes);
  void resolve(Nodes& nodes);

 private:
  void resolve_reference(const AttributeSchema& schema, const std::string& name, const FileLocation& where);
  void resolve_event(const AttributeSchema& schema, const Event& event, const FileLocation& where);
  void resolve_override(Node& node);
  bool is_known(const std::string& name, const AttributeSchema& schema) const;
  std::vector<std::string> known_names(const std::vector<std::string>& types) const;
  void fail(Error error) { tell_(std::move(error)); }

  const ScriptNames& names_;
  const Roots& roots_;
  const std::function<void(Error)>& tell_;
  std::map<std::string, const Node*> nodes_;  ///< by their names
};

void NameResolver::know_nodes(const Nodes& nodes) {
  for (const Node& node : nodes) {
    if (node.schema->is_unique)
      for (const std::string& name : unique_names(node.schema->type)) nodes_.emplace(name, &node);
    if (node.schema->find("name") && node.gives("name")) nodes_.emplace(node.text("name"), &node);
    know_nodes(node.children);
  }
}

/// Whether a reference may have the name; scripts have hundreds of thousands of references.
bool NameResolver::is_known(const std::string& name, const AttributeSchema& schema) const {
  const std::vector<std::string>& types = schema.refers_to;
  if (std::ranges::find(schema.choices, name) != schema.choices.end()) return true;
  const auto node = nodes_.find(name);
  if (node == nodes_.end()) return types.empty() && names_.given.count(name) > 0;
  return types.empty() || std::ranges::find(types, node->second->schema->type) != types.end();
}

/// Names of nodes of these types, or, where none is named, of everything that has a name.
std::vector<std::string> NameResolver::known_names(const std::vector<std::string>& types) const {
  std::vector<std::string> known;
  for (const auto& [name, node] : nodes_)
    if (types.empty() || std::find(types.begin(), types.end(), node->schema->type) != types.end())
      known.push_back(name);
  if (types.empty())
    for (const auto& [name, where] : names_.given)
      if (!nodes_.count(name)) known.push_back(name);
  return known;
}

void NameResolver::resolve(Nodes& nodes) {
  for (Node& node : nodes) {
    for (const NodeAttribute& attribute : node.attributes) {
      const AttributeSchema& schema = *attribute.schema;
      if (schema.type == AttributeType::reference) resolve_reference(schema, attribute.text, attribute.where);
      if (schema.type == AttributeType::event)
        resolve_event(schema, std::get<Event>(attribute.value), attribute.where);
    }
    if (!node.schema->takes_attributes_of.empty()) resolve_override(node);
    resolve(node.children);
  }
}

void NameResolver::resolve_reference(const AttributeSchema& schema, const std::string& name,
                                     const FileLocation& where) {
  if (is_known(name, schema)) return;
  std::vector<std::string> known = known_names(schema.refers_to);
  known.insert(known.end(), schema.choices.begin(),
               schema.choices.end());  // sources of events that are no nodes
  const std::string shown = name.substr(0, 40);
  if (const auto other = nodes_.find(name); other != nodes_.end())
    return fail(error_at(where, "{}=\"{}\": this is a {}; expected {}{}", schema.name, shown,
                         other->second->schema->type, expectation(schema), names_that_exist(name, known)));
  if (name.starts_with('%'))
    return fail(error_at(where, "{}=\"{}\": the scene has no {} node{}", schema.name, shown, shown.substr(1),
                         names_that_exist(name, known)));
  fail(error_at(where, "{}=\"{}\": no node of the scene has this name{}", schema.name, shown,
                names_that_exist(name, known)));
}

void NameResolver::resolve_event(const AttributeSchema& schema, const Event& event,
                                 const FileLocation& where) {
  if (schema.source == AttributeType::reference) resolve_reference(schema, event.source, where);
  const auto target = nodes_.find(event.target);
  if (target == nodes_.end()) {
    if (names_.given.count(event.target))
      return fail(error_at(where, "{}: \"{}\" is made when the scene runs and takes no messages", schema.name,
                           event.target));
    return fail(error_at(where, "{}: no node of the scene is called \"{}\"{}", schema.name,
                         event.target.substr(0, 40), names_that_exist(event.target, known_names({}))));
  }
  const Node& node = *target->second;
  const Result<Message> message = parse_message(*node.schema, event.message, where);
  if (!message) {
    for (const Error& error : message.errors())
      fail(error_at(where, "{}: \"{}\": {}", schema.name, event.target, error.message));
    return;
  }
  for (std::size_t i = 0; i < message->arguments.size(); ++i) {
    const AttributeSchema& argument = message->schema->arguments[i];
    const auto* name = std::get_if<std::string>(&message->arguments[i]);
    if (argument.type == AttributeType::reference) resolve_reference(argument, *name, where);
    if (argument.type != AttributeType::child) continue;
    const auto can_be_hidden = [&](const std::string& inside) {
      const Node* found = find_node(node.children, inside);
      return found && found->schema->find("visible");
    };
    if (can_be_hidden(*name)) continue;
    std::vector<std::string> inside;
    for (const std::string& known : known_names({}))
      if (can_be_hidden(known)) inside.push_back(known);
    fail(error_at(where, "{}: \"{}\": {} holds nothing to be seen that is called \"{}\"{}", schema.name,
                  event.message, event.target, name->substr(0, 40), names_that_exist(*name, inside)));
  }
}

/// Reads the attributes that the node gives to another one by that one's schema.
void NameResolver::resolve_override(Node& node) {
  const std::string& by = node.schema->takes_attributes_of;
  const auto target = node.gives(by) ? nodes_.find(node.text(by)) : nodes_.end();
  if (target == nodes_.end()) return;  // reported already
  const NodeSchema& schema = *target->second->schema;
  const auto unexplained = names_.unexplained.find(place_of(node.where));
  if (unexplained == names_.unexplained.end()) return;
  for (const ScriptAttribute& written : unexplained->second) {
    const FileLocation at_name{node.where.file, written.name_place.line, written.name_place.column};
    const FileLocation at_value{node.where.file, written.value_place.line, written.value_place.column};
    const AttributeSchema* attribute = schema.find(written.name);
    std::vector<std::string> known;
    for (const AttributeSchema& each : schema.attributes)
      if (each.name != "name" && !each.is_kept && (each.is_live || !schema.is_laid_out_once))
        known.push_back(each.name);
    if (!attribute || std::find(known.begin(), known.end(), attribute->name) == known.end()) {
      if (attribute && schema.is_laid_out_once)
        fail(error_at(at_name, "{} \"{}\" is laid out once: its \"{}\" is the same in all scenarios",
                      schema.type, node.text(by), attribute->name));
      else
        fail(error_at(at_name, "{} \"{}\" {} \"{}\"{}", schema.type, node.text(by),
                      attribute ? "keeps, once the scene is loaded, its" : "has no attribute",
                      written.name.substr(0, 40), names_that_exist(written.name, known)));
      continue;
    }
    Result<AttributeValue> value = parse_value(*attribute, written.value, roots_, at_value);
    if (!value) {
      for (const Error& error : value.errors()) fail(error);
      continue;
    }
    if (attribute->type == AttributeType::reference) resolve_reference(*attribute, written.value, at_value);
    if (attribute->type == AttributeType::event) resolve_event(*attribute, std::get<Event>(*value), at_value);
    node.overrides.push_back({attribute, std::move(*value), written.value, at_value});
  }
}

}  // namespace

void resolve_names(Nodes& nodes, const ScriptNames& names, const Roots& roots,
                   const std::function<void(Error)>& fail, const Nodes& others) {
  NameResolver resolver(names, roots, fail);
  resolver.know_nodes(nodes);
  resolver.know_nodes(others);
  resolver.resolve(nodes);
}

}  // namespace parvis::scene
