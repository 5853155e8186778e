// The panel's page of the scene: its nodes as a tree, and the attributes of the chosen one, changed live.
#pragma once

#include <set>
#include <string>

#include "viewer/panel_rows.h"
#include "viewer/visit.h"

namespace parvis::viewer {

class PanelNodes {
 public:
  /// Draws into ImGui's current window, to its end.
  void draw(Visit& visit, PanelRows& rows);
  /// Shows a node's attributes, and opens the tree down to it.
  void choose(const scene::LiveScene& live, const scene::Node& node);
  const scene::Node* chosen() const { return chosen_; }

 private:
  /// A value that an attribute refused.
  struct Refusal {
    const scene::AttributeSchema* attribute = nullptr;
    std::string message;
  };

  void draw_tree(Visit& visit, PanelRows& rows);
  void draw_row(Visit& visit, PanelRows& rows, const NodeRow& row);
  void draw_name(PanelRows& rows, const NodeRow& row);
  void draw_attributes(Visit& visit, PanelRows& rows);
  void draw_attribute(Visit& visit, PanelRows& rows, AttributeRow row);

  std::string filter_;
  std::set<const scene::Node*> open_;
  const scene::Node* chosen_ = nullptr;
  bool scrolls_to_chosen_ = false;  ///< in the next frame
  Refusal refusal_;
};

}  // namespace parvis::viewer
