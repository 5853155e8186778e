#include "scene/script_checker.h"

#include <algorithm>
#include <map>

#include "scene/message.h"
#include "scene/script_reader.h"
#include "scene/script_tokens.h"
#include "scene/spelling.h"

namespace parvis::scene {
namespace {
namespace fs = std::filesystem;

/// A node's place, to be looked up by.
std::pair<std::string, std::pair<int, int>> key(const FileLocation& where) {
  return {where.file, {where.line, where.column}};
}

class Checker {
 public:
  Checker(const NodeRegistry& registry, const Roots& roots) : registry_(registry), roots_(roots) {}

  Result<std::vector<Node>> scene(const fs::path& script) {
    std::vector<Node> nodes = file(script, top_level, {script.string()});
    if (!is_incomplete_) {
      know_nodes(nodes);
      resolve(nodes);
    }
    if (!errors_.empty()) return std::move(errors_);
    return nodes;
  }

 private:
  std::vector<Node> file(const fs::path& script, const std::string& parent, const FileLocation& asked_at);
  std::vector<Node> nodes(const std::vector<ScriptNode>& written, const std::string& file,
                          const std::string& parent);
  Node node(const ScriptNode& written, const NodeType& type, const std::string& file);
  void attribute(Node& node, const ScriptAttribute& written, const std::string& file);
  void check_place(const ScriptNode& written, const NodeSchema& schema, const std::string& file,
                   const std::string& parent);
  void check_unique(const std::string& type, const FileLocation& where);
  std::vector<Node> included(const Node& include, const std::string& parent);
  void note_name(const std::string& name, const FileLocation& where);
  void know_nodes(const std::vector<Node>& nodes);
  void resolve(std::vector<Node>& nodes);
  void resolve_reference(const AttributeSchema& schema, const std::string& name, const FileLocation& where);
  void resolve_event(const AttributeSchema& schema, const Event& event, const FileLocation& where);
  void resolve_override(Node& node);
  std::vector<std::string> known_names(const std::vector<std::string>& types) const;

  void fail(Error error) {
    if (errors_.size() < max_script_errors) errors_.push_back(std::move(error));
  }
  void fail(const Errors& errors) {
    for (const Error& error : errors) fail(error);
  }

  const NodeRegistry& registry_;
  const Roots& roots_;
  Errors errors_;
  std::map<std::string, FileLocation> names_, unique_nodes_;
  std::map<std::string, const Node*> nodes_;  ///< by their names, when all files are read
  /// Attributes that another node's type must explain, by the place of the node that gives them.
  std::map<std::pair<std::string, std::pair<int, int>>, std::vector<ScriptAttribute>> unexplained_;
  std::vector<fs::path> open_files_;  ///< the chain of includes
  std::size_t node_count_ = 0, include_count_ = 0;
  bool is_incomplete_ = false;  ///< a file could not be read: names may be missing
};

std::vector<Node> Checker::file(const fs::path& script, const std::string& parent,
                                const FileLocation& asked_at) {
  std::error_code code;
  const std::uintmax_t size = fs::is_regular_file(script, code) ? fs::file_size(script, code) : 0;
  if (size > max_script_bytes) {
    fail(error_at(asked_at, "{}: the script is larger than {} MB; geometry belongs in model files",
                  script.string(), max_script_bytes >> 20));
    return {};
  }
  const Result<std::string> text = read_file(script);
  if (!text) return is_incomplete_ = true, fail(text.errors()), std::vector<Node>();
  const Result<std::vector<ScriptNode>> written = parse_script(*text, script.string());
  if (!written) return is_incomplete_ = true, fail(written.errors()), std::vector<Node>();

  open_files_.push_back(script);
  std::vector<Node> result = nodes(*written, script.string(), parent);
  open_files_.pop_back();
  return result;
}

std::vector<Node> Checker::nodes(const std::vector<ScriptNode>& written, const std::string& file,
                                 const std::string& parent) {
  std::vector<Node> result;
  for (const ScriptNode& child : written) {
    if (errors_.size() >= max_script_errors) break;
    const FileLocation where{file, child.place.line, child.place.column};
    if (++node_count_ > max_scene_nodes) {
      if (node_count_ == max_scene_nodes + 1)
        fail(
            error_at(where, "the scene with all that it includes holds more than {} nodes", max_scene_nodes));
      break;
    }
    const NodeType* type = registry_.find(child.type);
    if (!type) {
      fail(error_at(where, "unknown node type \"{}\"{}", child.type.substr(0, 40),
                    did_you_mean(child.type, registry_.type_names())));
      continue;
    }
    check_place(child, type->schema, file, parent);
    if (type->schema.is_unique) check_unique(child.type, where);
    Node checked = node(child, *type, file);
    checked.children = nodes(child.children, file, child.type);
    if (child.type == include_type) {
      std::vector<Node> included_nodes = included(checked, parent);
      std::move(included_nodes.begin(), included_nodes.end(), std::back_inserter(result));
    } else {
      result.push_back(std::move(checked));
    }
  }
  return result;
}

void Checker::check_place(const ScriptNode& written, const NodeSchema& schema, const std::string& file,
                          const std::string& parent) {
  const std::vector<std::string>& parents = schema.stands_in;
  if (std::find(parents.begin(), parents.end(), parent) != parents.end()) return;
  const FileLocation where{file, written.place.line, written.place.column};
  const std::vector<std::string> allowed = registry_.children_of(parent);
  if (parent == top_level)
    fail(error_at(where, "{} does not stand by itself but in {}", schema.type, fmt::join(parents, " or ")));
  else if (allowed.empty())
    fail(error_at(where, "{} takes no children; put {} behind its '}}'", parent, schema.type));
  else
    fail(error_at(where, "{} does not stand in {}, which takes {}", schema.type, parent,
                  fmt::join(allowed, ", ")));
}

void Checker::check_unique(const std::string& type, const FileLocation& where) {
  const auto [earlier, is_first] = unique_nodes_.emplace(type, where);
  if (!is_first)
    fail(error_at(where, "a scene has one {}; {}:{} has given it already", type, earlier->second.file,
                  earlier->second.line));
}

Node Checker::node(const ScriptNode& written, const NodeType& type, const std::string& file) {
  Node node;
  node.schema = &type.schema;
  node.where = {file, written.place.line, written.place.column};
  for (const ScriptAttribute& given : written.attributes)
    if (errors_.size() < max_script_errors) attribute(node, given, file);
  for (const AttributeSchema& schema : type.schema.attributes) {
    const auto given =
        std::find_if(written.attributes.begin(), written.attributes.end(),
                     [&](const ScriptAttribute& a) { return type.schema.find(a.name) == &schema; });
    if (schema.is_required && given == written.attributes.end())
      fail(error_at(node.where, "{} needs {}=: {}, {}", type.schema.type, schema.name, schema.help,
                    expectation(schema)));
  }
  if (type.schema.names_made)
    for (const std::string& name : type.schema.names_made(node)) note_name(name, node.where);
  return node;
}

void Checker::attribute(Node& node, const ScriptAttribute& written, const std::string& file) {
  const FileLocation at_name{file, written.name_place.line, written.name_place.column};
  const FileLocation at_value{file, written.value_place.line, written.value_place.column};
  const AttributeSchema* schema = node.schema->find(written.name);
  if (!schema && !node.schema->takes_attributes_of.empty()) {
    unexplained_[key(node.where)].push_back(written);
    return;
  }
  if (!schema) {
    std::vector<std::string> known;
    known.reserve(node.schema->attributes.size());
    for (const AttributeSchema& each : node.schema->attributes) known.push_back(each.name);
    return fail(error_at(at_name, "{} has no attribute \"{}\"{}", node.schema->type,
                         written.name.substr(0, 40), did_you_mean(written.name, known)));
  }
  if (!schema->is_repeatable && node.gives(schema->name))
    return fail(
        error_at(at_name, "{} is given twice in this {}; remove one", written.name, node.schema->type));
  Result<AttributeValue> value = parse_value(*schema, written.value, roots_, at_value);
  if (!value) return fail(value.errors());
  node.attributes.push_back({schema, std::move(*value), written.value, at_value});
  if (schema->name == "name") note_name(written.value, at_value);
}

void Checker::note_name(const std::string& name, const FileLocation& where) {
  if (name.empty()) return fail(error_at(where, "the name is empty; leave name= out or give one"));
  const auto [earlier, is_new] = names_.emplace(name, where);
  if (!is_new)
    fail(error_at(where, "the name \"{}\" is taken: {}:{} has it already; names are unique in a scene", name,
                  earlier->second.file, earlier->second.line));
}

/// The nodes of the file that `include` names: they stand in its place.
std::vector<Node> Checker::included(const Node& include, const std::string& parent) {
  if (!include.gives("file")) return {};
  const fs::path script = include.file("file");
  const FileLocation& where = include.where_of("file");
  const auto open = std::find(open_files_.begin(), open_files_.end(), script);
  if (open != open_files_.end()) {
    std::string chain;
    for (auto each = open; each != open_files_.end(); ++each) chain += each->filename().string() + " -> ";
    fail(error_at(where, "files include each other in a circle: {}{}", chain, script.filename().string()));
  } else if (open_files_.size() >= max_include_depth) {
    fail(error_at(where, "includes are nested more than {} deep", max_include_depth));
  } else if (++include_count_ > max_included_files) {
    if (include_count_ == max_included_files + 1)
      fail(error_at(where, "the scene includes more than {} files", max_included_files));
  } else {
    return file(script, parent, where);
  }
  return {};
}

/// After all files are read: a node may refer to one that comes later.
void Checker::know_nodes(const std::vector<Node>& nodes) {
  for (const Node& node : nodes) {
    if (node.schema->is_unique) nodes_.emplace("%" + node.schema->type, &node);
    if (node.schema->find("name") && node.gives("name")) nodes_.emplace(node.text("name"), &node);
    know_nodes(node.children);
  }
}

/// Of nodes of these types, or, where none is named, of everything that has a name.
std::vector<std::string> Checker::known_names(const std::vector<std::string>& types) const {
  std::vector<std::string> known;
  for (const auto& [name, node] : nodes_)
    if (types.empty() || std::find(types.begin(), types.end(), node->schema->type) != types.end())
      known.push_back(name);
  if (types.empty())
    for (const auto& [name, where] : names_)
      if (!nodes_.count(name)) known.push_back(name);
  return known;
}

void Checker::resolve(std::vector<Node>& nodes) {
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

void Checker::resolve_reference(const AttributeSchema& schema, const std::string& name,
                                const FileLocation& where) {
  std::vector<std::string> known = known_names(schema.refers_to);
  known.insert(known.end(), schema.choices.begin(),
               schema.choices.end());  // sources of events that are no nodes
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string shown = name.substr(0, 40);
  if (const auto other = nodes_.find(name); other != nodes_.end())
    return fail(error_at(where, "{}=\"{}\": this is a {}; expected {}{}", schema.name, shown,
                         other->second->schema->type, expectation(schema), did_you_mean(name, known)));
  fail(error_at(where, "{}=\"{}\": no node of the scene has this name{}", schema.name, shown,
                did_you_mean(name, known)));
}

void Checker::resolve_event(const AttributeSchema& schema, const Event& event, const FileLocation& where) {
  if (schema.source == AttributeType::reference) resolve_reference(schema, event.source, where);
  const auto target = nodes_.find(event.target);
  if (target == nodes_.end()) {
    if (names_.count(event.target))
      return fail(error_at(where, "{}: \"{}\" is made when the scene runs and takes no messages", schema.name,
                           event.target));
    return fail(error_at(where, "{}: no node of the scene is called \"{}\"{}", schema.name,
                         event.target.substr(0, 40), did_you_mean(event.target, known_names({}))));
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
                  event.message, event.target, name->substr(0, 40), did_you_mean(*name, inside)));
  }
}

/// Reads the attributes that the node gives to another one by that one's schema.
void Checker::resolve_override(Node& node) {
  const std::string& by = node.schema->takes_attributes_of;
  const auto target = node.gives(by) ? nodes_.find(node.text(by)) : nodes_.end();
  if (target == nodes_.end()) return;  // told already
  const NodeSchema& schema = *target->second->schema;
  for (const ScriptAttribute& written : unexplained_[key(node.where)]) {
    const FileLocation at_name{node.where.file, written.name_place.line, written.name_place.column};
    const FileLocation at_value{node.where.file, written.value_place.line, written.value_place.column};
    const AttributeSchema* attribute = schema.find(written.name);
    std::vector<std::string> known;
    for (const AttributeSchema& each : schema.attributes)
      if (each.name != "name" && (each.is_live || !schema.is_laid_out_once)) known.push_back(each.name);
    if (!attribute || std::find(known.begin(), known.end(), attribute->name) == known.end()) {
      fail(error_at(at_name, "{} \"{}\" {} \"{}\"{}", schema.type, node.text(by),
                    attribute ? "keeps, once the scene is loaded, its" : "has no attribute",
                    written.name.substr(0, 40), did_you_mean(written.name, known)));
      continue;
    }
    Result<AttributeValue> value = parse_value(*attribute, written.value, roots_, at_value);
    if (!value) {
      fail(value.errors());
      continue;
    }
    if (attribute->type == AttributeType::reference) resolve_reference(*attribute, written.value, at_value);
    if (attribute->type == AttributeType::event) resolve_event(*attribute, std::get<Event>(*value), at_value);
    node.overrides.push_back({attribute, std::move(*value), written.value, at_value});
  }
}

}  // namespace

Result<std::vector<Node>> check_script(const fs::path& script, const NodeRegistry& registry,
                                       const Roots& roots) {
  std::error_code code;
  const fs::path canonical = fs::weakly_canonical(script, code);
  return Checker(registry, roots).scene(code ? script : canonical);
}

}  // namespace parvis::scene
