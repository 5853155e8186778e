#include "viewer/panel_nodes.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <map>
#include <utility>

namespace parvis::viewer {
namespace {

constexpr float share_of_tree = 0.45f;  // of the page's height; attributes have the rest

/// The name by which a node's row is found.
std::string row_name(const NodeRow& row) { return "node " + (row.name.empty() ? row.kind : row.name); }

/// Draws what changes the value; true when a person has changed it.
bool draw_editor(PanelRows& rows, AttributeRow& row) {
  const scene::AttributeSchema& schema = *row.schema;
  const DragStyle style = drag_style(schema);
  switch (row.editor) {
    case Editor::flag: {
      bool is_on = row.numbers[0] != 0.0;
      const bool changes = rows.flag(row.label, is_on, schema.help);
      row.numbers[0] = is_on ? 1.0 : 0.0;
      return changes;
    }
    case Editor::number:
    case Editor::whole_number:
      return rows.drag(row.label, row.numbers.data(), 1, style, schema.minimum, schema.maximum, schema.help);
    case Editor::three_numbers:
      return rows.drag(row.label, row.numbers.data(), 3, {style.speed, "%.2f"}, schema.minimum,
                       schema.maximum, schema.help);
    case Editor::colour:
      return rows.colour(row.label, row.numbers, style, schema.help);
    case Editor::choice: {
      const std::optional<std::size_t> chosen = rows.choice(row.label, schema.choices, row.text, schema.help);
      if (chosen) row.text = schema.choices[*chosen];
      return chosen.has_value();
    }
    case Editor::text:
      return rows.text(row.label, row.text, schema.help);
  }
  return false;
}

void draw_fixed(PanelRows& rows, const AttributeRow& row) {
  ImGui::BeginDisabled();
  rows.value(row.label, row.text.empty() ? "not given" : row.text);
  ImGui::EndDisabled();
}

}  // namespace

void PanelNodes::choose(const scene::LiveScene& live, const scene::Node& node) {
  filter_.clear();
  for (const scene::Node* around = live.parent_of(node); around; around = live.parent_of(*around))
    open_.insert(around);
  chosen_ = &node, refusal_ = {};
  scrolls_to_chosen_ = true;
}

void PanelNodes::draw(Visit& visit, PanelRows& rows) {
  ImGui::SetNextItemWidth(-FLT_MIN);
  ImGui::InputTextWithHint("##find", rows.word("find by name or kind").c_str(), &filter_);
  rows.note_place("find");
  const float height = ImGui::GetContentRegionAvail().y;
  ImGui::BeginChild("tree", {0.0f, chosen_ ? share_of_tree * height : 0.0f});
  draw_tree(visit, rows);
  ImGui::EndChild();
  if (!chosen_) return;
  ImGui::Separator();
  ImGui::BeginChild("attributes");
  draw_attributes(visit, rows);
  ImGui::EndChild();
}

void PanelNodes::draw_tree(Visit& visit, PanelRows& rows) {
  const std::vector<NodeRow> nodes = node_rows(visit.live(), open_, filter_);
  if (nodes.empty())
    rows.remark(filter_.empty() ? "The scene has no nodes: it was not made by a script."
                                : "No node has such a name or kind.");
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 1.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.x, 2.0f});
  if (std::exchange(scrolls_to_chosen_, false)) {
    const auto row =
        std::find_if(nodes.begin(), nodes.end(), [&](const NodeRow& each) { return each.node == chosen_; });
    const float row_height = ImGui::GetFrameHeightWithSpacing(), shown = ImGui::GetWindowHeight();
    ImGui::SetScrollY(row_height * float(row - nodes.begin()) - 0.5f * shown);
  }
  ImGuiListClipper clipper;
  clipper.Begin(int(nodes.size()));
  while (clipper.Step())
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
      draw_row(visit, rows, nodes[std::size_t(i)]);
  ImGui::PopStyleVar(2);
}

void PanelNodes::draw_row(Visit& visit, PanelRows& rows, const NodeRow& row) {
  const float right = ImGui::GetContentRegionMax().x, left = ImGui::GetCursorPosX();
  float free = right;
  ImGui::PushID(row.node);
  if (row.can_hide) {  // before the row: the mouse belongs to who comes first
    bool is_visible = row.is_visible;
    free -= ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x;
    ImGui::SetCursorPosX(right - ImGui::GetFrameHeight());
    if (ImGui::Checkbox("##visible", &is_visible))
      if (const Status status = visit.tell(*row.node, is_visible ? "show" : "hide"); !status)
        visit.notice_error(to_string(status.errors()));
    rows.note_place(row_name(row) + "/visible");
    ImGui::SameLine(left);
  }
  draw_name(rows, row);
  const std::string& detail = row.name.empty() ? row.says : row.kind;
  ImGui::SameLine(std::max(free - ImGui::CalcTextSize(detail.c_str()).x, 0.4f * right));
  ImGui::TextDisabled("%s", detail.c_str());
  ImGui::PopID();
}

void PanelNodes::draw_name(PanelRows& rows, const NodeRow& row) {
  const float indent =
      float(row.depth) * ImGui::GetStyle().IndentSpacing + 0.01f;  // 0 would be the style's own
  ImGui::Indent(indent);
  ImGui::SetNextItemOpen(row.is_open);
  ImGui::PushStyleColor(ImGuiCol_Text, row.is_in_sight ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : dim_text);
  const ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanAvailWidth | ImGuiTreeNodeFlags_OpenOnArrow |
                                   ImGuiTreeNodeFlags_OpenOnDoubleClick |
                                   ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_FramePadding |
                                   (row.has_children ? 0 : ImGuiTreeNodeFlags_Leaf) |
                                   (row.node == chosen_ ? ImGuiTreeNodeFlags_Selected : 0);
  const bool is_open =
      ImGui::TreeNodeEx("##row", flags, "%s", row.name.empty() ? row.kind.c_str() : row.name.c_str());
  ImGui::PopStyleColor();
  rows.note_place(row_name(row));
  if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen()) chosen_ = row.node, refusal_ = {};
  if (is_open != row.is_open && filter_.empty() && !open_.insert(row.node).second) open_.erase(row.node);
  ImGui::Unindent(indent);
}

void PanelNodes::draw_attributes(Visit& visit, PanelRows& rows) {
  rows.heading(
      (chosen_->schema->type + " " + (chosen_->schema->find("name") ? chosen_->text("name") : "")).c_str());
  rows.remark(chosen_->schema->help);
  std::map<std::string, std::vector<AttributeRow>> rows_by_reason;  // those without one come first
  for (AttributeRow& row : attribute_rows(visit.live(), *chosen_))
    rows_by_reason[row.fixed_because].push_back(std::move(row));
  ImGui::PushID(chosen_);
  for (const auto& [fixed_because, some_rows] : rows_by_reason) {
    if (!fixed_because.empty()) rows.remark("Fixed: " + fixed_because + ".");
    for (const AttributeRow& row : some_rows)
      fixed_because.empty() ? draw_attribute(visit, rows, row) : draw_fixed(rows, row);
  }
  ImGui::PopID();
}

void PanelNodes::draw_attribute(Visit& visit, PanelRows& rows, AttributeRow row) {
  if (!row.is_given) ImGui::PushStyleColor(ImGuiCol_Text, dim_text);
  const bool changes = draw_editor(rows, row);
  if (!row.is_given) ImGui::PopStyleColor();
  if (changes) {
    Result<scene::AttributeValue> value = edited_value(row);
    const Status status = value ? visit.tell(*chosen_, *row.schema, *std::move(value)) : value.errors();
    refusal_ = status ? Refusal{} : Refusal{row.schema, status.errors().front().message};
  }
  if (refusal_.attribute == row.schema) rows.remark(refusal_.message, error_text);
}

}  // namespace parvis::viewer
