// The panel's rows for a scene's nodes, as plain data derived from their schemas, and the value that an edit
// gives. Independent of the window: panel_nodes.cpp draws the rows.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "scene/script/live_scene.h"

namespace parvis::viewer {

/// A node in the tree or in the search result.
struct NodeRow {
  const scene::Node* node = nullptr;
  int depth = 0;
  bool has_children = false, is_open = false;
  bool can_hide = false;    ///< it takes `show` and `hide`
  bool is_visible = true;   ///< by its own attribute
  bool is_in_sight = true;  ///< and none around it is hidden
  std::string kind, name;   ///< "model", "oaks"; the name may be empty
  std::string says;         ///< the first that the script gives it: distinguishes unnamed nodes
};

/// The text with its ASCII letters in lower case.
std::string lower(std::string text);

/// The rows of the tree: children follow a node that is in `open`. With a `filter`: the nodes whose kind or
/// name contains it (any case), and their ancestors.
std::vector<NodeRow> node_rows(const scene::LiveScene& live, const std::set<const scene::Node*>& open,
                               const std::string& filter = "");

/// Kind of widget for a value.
enum class Editor : unsigned char { text, number, whole_number, flag, choice, three_numbers, colour };

/// The present state of one attribute of a node.
struct AttributeRow {
  const scene::AttributeSchema* schema = nullptr;
  Editor editor = Editor::text;
  std::string label;                ///< "heading" of heading_deg
  std::string text;                 ///< as a script writes it; empty: it has no value
  std::array<double, 3> numbers{};  ///< in the script's units: degrees; a flag is 0 or 1
  bool is_given = false;            ///< by the script, a message or a scenario; else it is the default
  std::string fixed_because;        ///< why it cannot be changed while the scene runs; empty: it can
};

/// The attributes of a node in the order of its schema.
std::vector<AttributeRow> attribute_rows(const scene::LiveScene& live, const scene::Node& node);

/// Sensitivity and format of a number that is edited by dragging.
struct DragStyle {
  float speed = 0.01f;  ///< per pixel, in the script's units
  std::string format;   ///< printf format: "%.2f m"
};
/// The style for an attribute's type and unit.
DragStyle drag_style(const scene::AttributeSchema& schema);

/// The row's content as the attribute's value: its numbers, or its text where text is edited. An error says
/// what the attribute expects of a text, also of an empty one where it is required or the name of a node.
Result<scene::AttributeValue> edited_value(const AttributeRow& row);

}  // namespace parvis::viewer
