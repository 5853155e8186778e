// A line in which any command of the planner's tool is written by its name, with what it expects.
#pragma once

#include <string>
#include <vector>

#include "viewer/imgui_context.h"
#include "viewer/panel_rows.h"
#include "viewer/planning.h"

struct ImGuiInputTextCallbackData;

namespace parvis::viewer {

/// The line, which keeps its text and what was run before.
class CommandLine {
 public:
  /// Both outlive it.
  CommandLine(const ImguiContext& imgui, Planning& planning) : imgui_(imgui), planning_(planning) {}

  /// Draws the line while `Planning::shows_commands`, with its foot at a height of the window, in ImGui's
  /// units, in the middle of a picture of this width. Enter runs what is written, Tab completes the last
  /// word, the arrows bring back what was run, Escape closes. Returns its height.
  float draw(float picture_width, float foot, Places& places);

 private:
  bool run(const std::string& text);
  void complete(ImGuiInputTextCallbackData& data) const;
  void recall(ImGuiInputTextCallbackData& data);

  const ImguiContext& imgui_;
  Planning& planning_;
  std::string text_;
  std::vector<std::string> run_;  ///< what was run, the latest last
  std::size_t recalled_ = 0;      ///< of these; their number: none
  bool was_open_ = false, wants_keys_ = false, took_keys_ = false;
};

/// Forms of the commands whose verb begins so, in the order of design::command_forms, those of the window
/// behind them; where the text has its verb and a blank, the form of this verb alone.
std::vector<std::string> forms_for(std::string_view text);

/// The end of the text's last word: the longest beginning that the words which begin so have in common,
/// without what is there. Words of a list of names, which commas part, count one by one.
std::string completion(std::string_view text, const std::vector<std::string>& words);

}  // namespace parvis::viewer
