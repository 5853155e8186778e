#include "viewer/command_line.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <utility>

#include "planning/design/command.h"
#include "planning/design/kind.h"

namespace parvis::viewer {
namespace {

/// A command of the window alone: no edit of the design.
struct WindowCommand {
  const char* verb;
  void (*run)(Planning& planning);
};
constexpr std::array window_commands{
    WindowCommand{"undo", [](Planning& planning) { planning.undo(); }},
    WindowCommand{"redo", [](Planning& planning) { planning.redo(); }},
    WindowCommand{"save", [](Planning& planning) { planning.save(); }},
    WindowCommand{"plan", [](Planning& planning) { planning.look(PlanningView::plan); }},
    WindowCommand{"street", [](Planning& planning) { planning.look(PlanningView::street); }},
    WindowCommand{"balcony", [](Planning& planning) { planning.look(PlanningView::balcony); }},
    WindowCommand{"frame", [](Planning& planning) { planning.frame_selection(); }},
    WindowCommand{"compare", [](Planning& planning) { planning.compare_with_next(); }},
    WindowCommand{"slider", [](Planning& planning) { planning.next_compared_view(); }},
};
constexpr const char* form_of_select =
    "select NAMES | all | none | kind KIND | like NAME | group NAME | box X,Y X,Y";

std::string verb_of(std::string_view form) { return std::string(form.substr(0, form.find(' '))); }

std::vector<std::string> all_forms() {
  std::vector<std::string> forms = design::command_forms();
  forms.emplace_back(form_of_select);
  for (const WindowCommand& command : window_commands) forms.emplace_back(command.verb);
  return forms;
}

}  // namespace

std::vector<std::string> forms_for(std::string_view text) {
  const std::size_t end = text.find(' ');
  const std::string_view verb = text.substr(0, end);
  std::vector<std::string> forms = all_forms();
  std::erase_if(forms, [&](const std::string& form) {
    return end == std::string_view::npos ? !verb_of(form).starts_with(verb) : verb_of(form) != verb;
  });
  return forms;
}

std::string completion(std::string_view text, const std::vector<std::string>& words) {
  const std::size_t before = text.find_last_of(" ,");
  const std::string_view begun = before == std::string_view::npos ? text : text.substr(before + 1);
  std::optional<std::string> common;
  for (const std::string& word : words) {
    if (!word.starts_with(begun)) continue;
    if (!common) common = word;
    const auto [end, ignored] = std::ranges::mismatch(*common, word);
    common->erase(end, common->end());
  }
  return common ? common->substr(begun.size()) : "";
}

bool CommandLine::run(const std::string& text) {
  for (const WindowCommand& command : window_commands)
    if (text == command.verb) return command.run(planning_), true;
  return planning_.run(text);
}

void CommandLine::complete(ImGuiInputTextCallbackData& data) const {
  const std::string_view text(data.Buf, std::size_t(data.CursorPos));
  std::vector<std::string> words;
  if (text.find(' ') == std::string_view::npos) {
    for (const std::string& form : all_forms()) words.push_back(verb_of(form) + " ");
  } else {
    words.emplace_back("selected");
    for (const design::Kind& kind : design::kinds_of(planning_.visit().scene())) words.push_back(kind.name);
    for (const design::PlacedObject& object : planning_.session()->objects()) words.push_back(object.name);
  }
  data.InsertChars(data.CursorPos, completion(text, words).c_str());
}

void CommandLine::recall(ImGuiInputTextCallbackData& data) {
  if (data.EventKey == ImGuiKey_UpArrow && recalled_ > 0) --recalled_;
  if (data.EventKey == ImGuiKey_DownArrow && recalled_ < run_.size()) ++recalled_;
  data.DeleteChars(0, data.BufTextLen);
  if (recalled_ < run_.size()) data.InsertChars(0, run_[recalled_].c_str());
}

float CommandLine::draw(float picture_width, float foot, Places& places) {
  const bool opens = planning_.shows_commands && !was_open_;
  const bool takes_keys = opens || (planning_.awaits_command_keys && !took_keys_);
  was_open_ = planning_.shows_commands;
  if (!planning_.shows_commands || !planning_.session()) return 0.0f;
  constexpr float usual_width = 620.0f, gap = 8.0f;  // at scale 1
  constexpr std::size_t shown_forms = 6;
  const float width = std::min(usual_width * imgui_.scale(), picture_width - 2.0f * gap);
  ImGui::SetNextWindowPos({0.5f * picture_width, foot - gap * imgui_.scale()}, ImGuiCond_Always,
                          {0.5f, 1.0f});
  ImGui::SetNextWindowSize({width, 0.0f});
  ImGui::SetNextWindowBgAlpha(0.93f);
  ImGui::Begin("commands", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  const std::vector<std::string> forms = forms_for(text_);
  ImGui::PushTextWrapPos(0.0f);
  for (std::size_t i = 0; i < std::min(forms.size(), shown_forms); ++i)
    ImGui::TextColored(dim_text, "%s", forms[i].c_str());
  if (forms.size() > shown_forms) ImGui::TextColored(dim_text, "... %zu", forms.size() - shown_forms);
  if (forms.empty()) ImGui::TextColored(error_text, "%s", planning_.word("no command begins so").c_str());
  ImGui::PopTextWrapPos();
  if (opens) recalled_ = run_.size(), text_.clear();
  if (std::exchange(wants_keys_, false) || takes_keys) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool is_entered = ImGui::InputTextWithHint(
      "##command", planning_.word("a command; Tab completes it, Enter runs it, Esc closes").c_str(), &text_,
      ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCompletion |
          ImGuiInputTextFlags_CallbackHistory,
      [](ImGuiInputTextCallbackData* data) {
        CommandLine& line = *static_cast<CommandLine*>(data->UserData);
        data->EventFlag == ImGuiInputTextFlags_CallbackCompletion ? line.complete(*data) : line.recall(*data);
        return 0;
      },
      this);
  places["command"] = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
  const bool closes = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
  const float height = ImGui::GetWindowSize().y + gap * imgui_.scale();
  ImGui::End();
  planning_.awaits_command_keys = took_keys_ = takes_keys;  // the line has them from the next frame on
  wants_keys_ = is_entered;                                 // ImGui leaves the line with Enter
  if (is_entered && !text_.empty() && !forms.empty() && run(text_)) {
    run_.push_back(std::exchange(text_, {}));
    recalled_ = run_.size();
  }
  if (closes) planning_.shows_commands = false;
  return height;
}

}  // namespace parvis::viewer
