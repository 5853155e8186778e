#include "viewer/panel_rows.h"

#include <imgui_stdlib.h>

#include <algorithm>

#include "base/colour.h"

namespace parvis::viewer {
namespace {

constexpr float share_of_names = 0.38f;  // of a row's width

}  // namespace

void PanelRows::note_place(const std::string& name) {
  places_[name] = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
}

void PanelRows::heading(const char* text) {
  ImGui::Dummy({0.0f, 0.3f * ImGui::GetTextLineHeight()});
  ImGui::PushFont(fonts_.heading);
  ImGui::TextUnformatted(word(text).c_str());
  ImGui::PopFont();
}

void PanelRows::remark(const std::string& text, const ImVec4& colour) {
  ImGui::PushStyleColor(ImGuiCol_Text, colour);
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(word(text).c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
}

/// Writes the name; what comes next fills the rest of the row.
void PanelRows::begin(const std::string& name, const std::string& help) {
  const float left = ImGui::GetCursorPosX(), width = ImGui::GetContentRegionAvail().x;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::AlignTextToFramePadding();
  ImGui::PushClipRect(corner, {corner.x + share_of_names * width, corner.y + 2.0f * ImGui::GetFrameHeight()},
                      true);
  ImGui::TextUnformatted(word(name).c_str());
  ImGui::PopClipRect();
  if (!help.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", word(help).c_str());
  ImGui::SameLine(left + share_of_names * width);
  ImGui::SetNextItemWidth(-FLT_MIN);
}

void PanelRows::value(const std::string& name, const std::string& text) {
  begin(name, "");
  ImGui::PushStyleColor(ImGuiCol_Text, dim_text);
  ImGui::TextUnformatted(word(text).c_str());
  ImGui::PopStyleColor();
  if (ImGui::IsItemHovered() && ImGui::CalcTextSize(text.c_str()).x > ImGui::GetContentRegionAvail().x)
    ImGui::SetTooltip("%s", text.c_str());
  note_place(name);
}

std::optional<std::size_t> PanelRows::choice(const std::string& name, const std::vector<std::string>& choices,
                                             const std::string& current, const std::string& help) {
  std::optional<std::size_t> chosen;
  begin(name, help);
  const bool is_open = ImGui::BeginCombo(("##" + name).c_str(), word(current).c_str());
  note_place(name);
  if (!is_open) return chosen;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    ImGui::PushID(int(i));
    if (ImGui::Selectable(choices[i].c_str(), choices[i] == current)) chosen = i;
    note_place(name + "/" + choices[i]);
    ImGui::PopID();
  }
  ImGui::EndCombo();
  return chosen;
}

bool PanelRows::flag(const std::string& name, bool& is_on, const std::string& help) {
  begin(name, help);
  const bool changes = ImGui::Checkbox(("##" + name).c_str(), &is_on);
  note_place(name);
  return changes;
}

/// Goes on from what a person has dragged so far.
void PanelRows::take_up(const std::string& name, double* numbers, int count) const {
  if (held_.id == ImGui::GetID(name.c_str())) std::copy_n(held_.numbers.begin(), count, numbers);
}

/// Remembers what the last item holds; true when it is to be told: each step of a drag, a written number at
/// its end.
bool PanelRows::hold(const std::string& name, const double* numbers, int count, bool changes) {
  const ImGuiID id = ImGui::GetID(name.c_str());
  if (ImGui::IsItemActive()) {
    held_.id = id;
    std::copy_n(numbers, count, held_.numbers.begin());
    const bool is_written = ImGui::GetIO().WantTextInput;
    return changes && !is_written;
  }
  if (held_.id == id) held_ = {};
  return changes || ImGui::IsItemDeactivatedAfterEdit();
}

bool PanelRows::drag(const std::string& name, double* numbers, int count, const DragStyle& style, double min,
                     double max, const std::string& help) {
  begin(name, help);
  take_up(name, numbers, count);
  const bool changes = ImGui::DragScalarN(("##" + name).c_str(), ImGuiDataType_Double, numbers, count,
                                          style.speed, &min, &max, style.format.c_str());
  note_place(name);
  return hold(name, numbers, count, changes);
}

bool PanelRows::colour(const std::string& name, std::array<double, 3>& linear, const DragStyle& style,
                       const std::string& help) {
  begin(name, help);
  take_up(name, linear.data(), 3);
  double strength = *std::max_element(linear.begin(), linear.end());
  const glm::vec3 colour =
      strength > 0.0 ? glm::vec3(linear[0], linear[1], linear[2]) / float(strength) : glm::vec3(1.0f);
  glm::vec3 srgb = srgb_from_linear(colour);
  const bool changes_hue =
      ImGui::ColorEdit3(("##hue of " + name).c_str(), &srgb.x,
                        ImGuiColorEditFlags_NoInputs | ImGuiColorEditFlags_PickerHueWheel);
  const bool holds_hue = ImGui::IsItemActive();
  note_place(name + "/hue");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-FLT_MIN);
  const double min = 0.0, max = 1e9;
  const bool changes_strength = ImGui::DragScalar(("##" + name).c_str(), ImGuiDataType_Double, &strength,
                                                  style.speed, &min, &max, style.format.c_str());
  note_place(name);
  if (changes_hue || changes_strength) {
    const glm::vec3 hue = linear_from_srgb(srgb);
    for (int i = 0; i < 3; ++i) linear[std::size_t(i)] = strength * double(hue[i]);
  }
  const bool tells_strength = hold(name, linear.data(), 3, changes_strength);
  if (holds_hue) held_ = {ImGui::GetID(name.c_str()), linear};
  return changes_hue || tells_strength;
}

bool PanelRows::text(const std::string& name, std::string& text, const std::string& help) {
  begin(name, help);
  const bool ends = ImGui::InputText(("##" + name).c_str(), &text, ImGuiInputTextFlags_EnterReturnsTrue);
  note_place(name);
  return ends;
}

std::optional<std::size_t> PanelRows::buttons(const std::vector<std::string>& names, std::size_t lit) {
  std::optional<std::size_t> pressed;
  const float spacing = ImGui::GetStyle().ItemInnerSpacing.x;
  const float count = float(names.size());
  const float width = (ImGui::GetContentRegionAvail().x - spacing * (count - 1.0f)) / count;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) ImGui::SameLine(0.0f, spacing);
    if (i == lit) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
    if (ImGui::Button((word(names[i]) + "###" + names[i]).c_str(), {width, 0.0f})) pressed = i;
    if (i == lit) ImGui::PopStyleColor();
    note_place(names[i]);
  }
  return pressed;
}

}  // namespace parvis::viewer
