#include "scene/script/script_checker.h"

#include <algorithm>
#include <map>

#include "base/known_names.h"
#include "scene/script/script_names.h"
#include "scene/script/script_reader.h"
#include "scene/script/script_tokens.h"
#include "scene/script/spelling.h"

namespace parvis::scene {
namespace {
namespace fs = std::filesystem;

class Checker {
 public:
  Checker(const NodeRegistry& registry, const Roots& roots) : registry_(registry), roots_(roots) {}

  Result<Nodes> scene(const fs::path& script) {
    Nodes nodes = file(script, top_level, {script.string()});
    add_implied(nodes);
    if (!is_incomplete_)
      resolve_names(nodes, names_, roots_, [this](Error error) { fail(std::move(error)); });
    if (!errors_.empty()) return std::move(errors_);
    return nodes;
  }

  Result<Nodes> piece(std::string_view text, const std::string& file, const std::string& parent,
                      const Nodes& others) {
    know(others);
    const Result<std::vector<ScriptNode>> written = parse_script(text, file);
    if (!written) return written.errors();
    Nodes made = nodes(*written, file, parent);
    if (!is_incomplete_)
      resolve_names(
          made, names_, roots_, [this](Error error) { fail(std::move(error)); }, others);
    if (!errors_.empty()) return std::move(errors_);
    return made;
  }

 private:
  void know(const Nodes& others);
  Nodes file(const fs::path& script, const std::string& parent, const FileLocation& asked_at);
  Nodes nodes(const std::vector<ScriptNode>& written, const std::string& file, const std::string& parent);
  Node node(const ScriptNode& written, const NodeType& type, const std::string& file);
  void attribute(Node& node, const ScriptAttribute& written, const std::string& file);
  void check_place(const ScriptNode& written, const NodeSchema& schema, const std::string& file,
                   const std::string& parent);
  void check_unique(const std::string& type, const FileLocation& where);
  void add_implied(Nodes& nodes);
  Nodes included(const Node& include, const std::string& parent);
  void note_name(const std::string& name, const FileLocation& where);

  void fail(Error error) {
    if (errors_.size() < max_script_errors) errors_.push_back(std::move(error));
  }
  void fail(const Errors& errors) {
    for (const Error& error : errors) fail(error);
  }

  const NodeRegistry& registry_;
  const Roots& roots_;
  Errors errors_;
  ScriptNames names_;
  std::map<std::string, FileLocation> unique_nodes_;
  std::vector<fs::path> open_files_;  ///< the chain of includes
  std::size_t node_count_ = 0, include_count_ = 0, byte_count_ = 0;
  bool is_incomplete_ = false;  ///< a file could not be read: names may be missing
};

Nodes Checker::file(const fs::path& script, const std::string& parent, const FileLocation& asked_at) {
  std::error_code code;
  const std::uintmax_t size = fs::is_regular_file(script, code) ? fs::file_size(script, code) : 0;
  if (size > max_script_bytes) {
    fail(error_at(asked_at, "{}: the script is larger than {} MB; geometry belongs in model files",
                  script.string(), max_script_bytes >> 20));
    return {};
  }
  if (byte_count_ > max_included_bytes) return is_incomplete_ = true, Nodes();  // reported before
  byte_count_ += std::size_t(size);
  if (byte_count_ > max_included_bytes) {
    is_incomplete_ = true;
    fail(error_at(asked_at,
                  "{}: the scene with all that it includes is larger than {} MB; include files once",
                  script.string(), max_included_bytes >> 20));
    return {};
  }
  const Result<std::string> text = read_file(script);
  if (!text) return is_incomplete_ = true, fail(text.errors()), Nodes();
  const Result<std::vector<ScriptNode>> written = parse_script(*text, script.string());
  if (!written) return is_incomplete_ = true, fail(written.errors()), Nodes();

  open_files_.push_back(script);
  Nodes result = nodes(*written, script.string(), parent);
  open_files_.pop_back();
  return result;
}

Nodes Checker::nodes(const std::vector<ScriptNode>& written, const std::string& file,
                     const std::string& parent) {
  Nodes result;
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
                    names_that_exist(child.type, registry_.type_names())));
      continue;
    }
    check_place(child, type->schema, file, parent);
    if (type->schema.is_unique) check_unique(type->schema.type, where);
    Node checked = node(child, *type, file);
    checked.children = nodes(child.children, file, type->schema.type);
    if (child.type == include_type) {
      Nodes included_nodes = included(checked, parent);
      std::move(included_nodes.begin(), included_nodes.end(), std::back_inserter(result));
    } else {
      result.push_back(std::move(checked));
    }
  }
  return result;
}

/// Names that are taken.
void Checker::know(const Nodes& others) {
  for (const Node& node : others) {
    ++node_count_;
    if (node.schema->is_unique) unique_nodes_.emplace(node.schema->type, node.where);
    if (node.schema->find("name") && node.gives("name")) names_.given.emplace(node.text("name"), node.where);
    if (node.schema->names_made)
      for (const std::string& name : node.schema->names_made(node)) names_.given.emplace(name, node.where);
    know(node.children);
  }
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
    names_.unexplained[place_of(node.where)].push_back(written);
    return;
  }
  if (!schema) {
    std::vector<std::string> known;
    known.reserve(node.schema->attributes.size());
    for (const AttributeSchema& each : node.schema->attributes) known.push_back(each.name);
    return fail(error_at(at_name, "{} has no attribute \"{}\"{}", node.schema->type,
                         written.name.substr(0, 40), names_that_exist(written.name, known)));
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
  const auto [earlier, is_new] = names_.given.emplace(name, where);
  if (!is_new)
    fail(error_at(where, "the name \"{}\" is taken: {}:{} has it already; names are unique in a scene", name,
                  earlier->second.file, earlier->second.line));
}

/// Where something is said of a node by one of its names; null: nowhere.
const FileLocation* place_of_reference(const Nodes& nodes, const std::array<std::string, 2>& names) {
  const auto is_among = [&](const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  for (const Node& node : nodes) {
    for (const NodeAttribute& attribute : node.attributes) {
      const Event* event = std::get_if<Event>(&attribute.value);
      const bool is_reference = attribute.schema->type == AttributeType::reference;
      if ((is_reference && is_among(attribute.text)) || (event && is_among(event->target)))
        return &attribute.where;
    }
    if (const FileLocation* inside = place_of_reference(node.children, names)) return inside;
  }
  return nullptr;
}

/// Nodes that every scene has, where the script speaks of them and does not write them.
void Checker::add_implied(Nodes& nodes) {
  for (const NodeType& type : registry_.types()) {
    const NodeSchema& schema = type.schema;
    if (!schema.is_implied || unique_nodes_.contains(schema.type)) continue;
    const FileLocation* asked = place_of_reference(nodes, unique_names(schema.type));
    if (!asked) continue;
    Node node;
    node.schema = &schema, node.where = *asked;
    nodes.push_back(std::move(node));
  }
}

/// The nodes of the file that `include` names: they stand in its place.
Nodes Checker::included(const Node& include, const std::string& parent) {
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

}  // namespace

Result<Nodes> check_script(const fs::path& script, const NodeRegistry& registry, const Roots& roots) {
  std::error_code code;
  const fs::path canonical = fs::weakly_canonical(script, code);
  return Checker(registry, roots).scene(code ? script : canonical);
}

Result<Nodes> check_piece(std::string_view text, const std::string& file, const std::string& parent,
                          const Nodes& others, const NodeRegistry& registry, const Roots& roots) {
  return Checker(registry, roots).piece(text, file, parent, others);
}

}  // namespace parvis::scene
