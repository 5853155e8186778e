#include "viewer/node_rows.h"

#include <algorithm>
#include <cctype>

namespace parvis::viewer {
namespace {

using scene::AttributeSchema, scene::AttributeType, scene::Node;

constexpr std::size_t longest_quote = 40;

std::string shortened(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.size() <= longest_quote) return text;
  text.resize(longest_quote);
  return text += "...";
}

std::string name_of(const Node& node) { return node.schema->find("name") ? node.text("name") : ""; }

/// Gathers the rows of one tree.
struct Rows {
  const std::set<const Node*>& open;
  const std::string filter;
  std::vector<NodeRow> rows;

  bool is_sought(const NodeRow& row) const {
    return lower(row.kind).find(filter) != std::string::npos ||
           lower(row.name).find(filter) != std::string::npos;
  }

  /// True where one of the nodes is sought, or one inside them.
  bool add(const scene::Nodes& nodes, int depth, bool is_in_sight) {
    bool any_is_sought = false;
    for (const Node& node : nodes) {
      NodeRow row;
      row.node = &node, row.depth = depth, row.has_children = !node.children.empty();
      row.kind = node.schema->type, row.name = name_of(node);
      if (!node.attributes.empty()) row.says = shortened(scene::written(node.attributes.front()));
      row.can_hide = node.schema->find("visible") != nullptr;
      row.is_visible = !row.can_hide || node.flag("visible");
      row.is_in_sight = is_in_sight && row.is_visible;
      row.is_open = row.has_children && (!filter.empty() || open.count(&node) != 0);
      bool is_wanted = is_sought(row);
      const bool is_open = row.is_open, stays_in_sight = row.is_in_sight;
      const std::size_t place = rows.size();
      rows.push_back(std::move(row));
      if (is_open) is_wanted |= add(node.children, depth + 1, stays_in_sight);
      if (!is_wanted) rows.resize(place);
      any_is_sought |= is_wanted;
    }
    return any_is_sought;
  }
};

Editor editor_of(AttributeType type) {
  switch (type) {
    case AttributeType::number:
    case AttributeType::angle:
      return Editor::number;
    case AttributeType::integer:
      return Editor::whole_number;
    case AttributeType::flag:
      return Editor::flag;
    case AttributeType::choice:
      return Editor::choice;
    case AttributeType::vec3:
      return Editor::three_numbers;
    case AttributeType::colour:
      return Editor::colour;
    default:
      return Editor::text;
  }
}

std::string label_of(const AttributeSchema& schema) {
  std::string label = schema.name;
  for (const char* unit : {"_deg", "_m", "_s"})
    if (label.ends_with(unit)) label.resize(label.size() - std::string(unit).size());
  std::replace(label.begin(), label.end(), '_', ' ');
  return label;
}

/// False of live numbers, colours and choices that a node leaves to what it refers to (the size of a placed
/// object is its kind's): there is nothing to show or to edit.
bool has_value(const Node& node, const AttributeSchema& schema) {
  return !schema.is_live || node.gives(schema.name) || !schema.fallback.empty() || schema.is_required ||
         schema.is_repeatable || editor_of(schema.type) == Editor::text;
}

std::string why_fixed(const scene::LiveScene& live, const Node& node, const AttributeSchema& schema) {
  if (!live.is_built(node)) return "part of the node around it, which is read when the scene is loaded";
  if (schema.is_live) return "";
  if (schema.name == "name") return "other nodes know it by this name";
  if (schema.type == AttributeType::file) return "files are read when the scene is loaded";
  if (schema.type == AttributeType::event) return "events are tied when the scene is loaded";
  if (node.schema->is_laid_out_once) return "laid out once, when the scene is loaded";
  return "settled when the scene is loaded";
}

/// The value that the script, a message or a scenario gives, else the default.
std::string text_of(const Node& node, const AttributeSchema& schema) {
  std::vector<std::string> given;
  for (const scene::NodeAttribute& attribute : node.attributes)
    if (attribute.schema == &schema) given.push_back(scene::written(attribute));
  if (given.empty()) return schema.fallback;
  if (given.size() == 1) return given.front();
  return fmt::format("{} values: {}", given.size(), shortened(given.front()));
}

std::array<double, 3> numbers_of(const Node& node, const AttributeSchema& schema) {
  switch (schema.type) {
    case AttributeType::number:
      return {node.number(schema.name)};
    case AttributeType::angle:
      return {glm::degrees(node.number(schema.name))};
    case AttributeType::integer:
      return {double(node.integer(schema.name))};
    case AttributeType::flag:
      return {node.flag(schema.name) ? 1.0 : 0.0};
    case AttributeType::vec3:
    case AttributeType::colour: {
      const glm::vec3 value = node.vec3(schema.name);
      return {double(value.x), double(value.y), double(value.z)};
    }
    default:
      return {};
  }
}

/// An empty text stands for none where the attribute may be left out; it is no name of a node.
bool may_be_empty(const AttributeSchema& schema) {
  return !schema.is_required && schema.type != AttributeType::reference &&
         schema.type != AttributeType::child;
}

}  // namespace

std::string lower(std::string text) {
  for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<NodeRow> node_rows(const scene::LiveScene& live, const std::set<const Node*>& open,
                               const std::string& filter) {
  Rows rows{open, lower(filter), {}};
  rows.add(live.nodes(), 0, true);
  return std::move(rows.rows);
}

std::vector<AttributeRow> attribute_rows(const scene::LiveScene& live, const Node& node) {
  std::vector<AttributeRow> rows;
  rows.reserve(node.schema->attributes.size());
  for (const AttributeSchema& schema : node.schema->attributes)
    if (has_value(node, schema))
      rows.push_back({&schema, editor_of(schema.type), label_of(schema), text_of(node, schema),
                      numbers_of(node, schema), node.gives(schema.name), why_fixed(live, node, schema)});
  return rows;
}

DragStyle drag_style(const AttributeSchema& schema) {
  if (schema.type == AttributeType::integer)
    return {0.25f, schema.unit.empty() ? "%.0f" : "%.0f " + schema.unit};
  if (schema.type == AttributeType::angle) return {0.25f, "%.1f°"};
  if (schema.unit == "m") return {0.02f, "%.2f m"};
  if (schema.unit == "1/m") return {0.00001f, "%.5f /m"};
  return {0.005f, schema.unit.empty() ? "%.3f" : "%.3f " + schema.unit};
}

Result<scene::AttributeValue> edited_value(const AttributeRow& row) {
  const auto [x, y, z] = row.numbers;
  switch (row.editor) {
    case Editor::text:
    case Editor::choice:
      if (row.text.find_first_not_of(" \t\r\n") == std::string::npos && !may_be_empty(*row.schema))
        return error("{} is empty; expected {}", row.schema->name, expectation(*row.schema));
      return parse_value(*row.schema, row.text, Roots(""), {});
    case Editor::number:
      return scene::AttributeValue(row.schema->type == AttributeType::angle ? glm::radians(x) : x);
    case Editor::whole_number:
      return scene::AttributeValue(std::lround(x));
    case Editor::flag:
      return scene::AttributeValue(x != 0.0);
    case Editor::three_numbers:
    case Editor::colour:
      break;
  }
  return scene::AttributeValue(glm::vec3(x, y, z));
}

}  // namespace parvis::viewer
