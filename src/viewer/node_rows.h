// What the panel shows of a scene's nodes, as plain rows out of their schemas, and how an edit becomes a
// message. Without a window: panel_nodes.cpp draws the rows.
#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "scene/script/live_scene.h"

namespace parvis::viewer {

/// A node in the tree, or of what is found in it.
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

/// The nodes from the top on; those inside a node follow it where it is in `open`. With a `filter`: those
/// whose kind or name holds it, without regard to case, and those around them.
std::vector<NodeRow> node_rows(const scene::LiveScene& live, const std::set<const scene::Node*>& open,
                               const std::string& filter = "");

/// How a value is edited.
enum class Editor : unsigned char { text, number, whole_number, flag, choice, three_numbers, colour };

/// One attribute of a node, as it is now.
struct AttributeRow {
  const scene::AttributeSchema* schema = nullptr;
  Editor editor = Editor::text;
  std::string label;                ///< "heading" of heading_deg
  std::string text;                 ///< as a script writes it; empty: it has no value
  std::array<double, 3> numbers{};  ///< in the script's units: degrees; a flag is 0 or 1
  bool is_given = false;            ///< by the script, a message or a scenario; else it is the default
  std::string fixed_because;        ///< why it cannot be changed while the scene runs; empty: it can
};

/// In the schema's order.
std::vector<AttributeRow> attribute_rows(const scene::LiveScene& live, const scene::Node& node);

/// How a drag over a number goes.
struct DragStyle {
  float speed = 0.01f;  ///< a pixel, in the script's units
  std::string format;   ///< of printf: "%.2f m"
};
DragStyle drag_style(const scene::AttributeSchema& schema);

/// The message that gives the attribute what the row holds: its numbers, or its text where it is edited as
/// such. "position 1 2 0".
std::string edit_message(const AttributeRow& row);

}  // namespace parvis::viewer
