#include "viewer/study_desk.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <utility>

#include "planning/study/performance.h"

namespace parvis::viewer {
namespace {

constexpr float instruction_width = 560.0f, questions_width = 720.0f;  // at scale 1
constexpr ImGuiWindowFlags desk_flags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                        ImGuiWindowFlags_AlwaysAutoResize;

std::string clock_text(double seconds) {
  return fmt::format("{}:{:02}", int(seconds) / 60, int(seconds) % 60);
}

}  // namespace

StudyDesk::StudyDesk(study::Session& session, Planning& planning, const ImguiContext& imgui)
    : session_(session),
      planning_(planning),
      imgui_(imgui),
      began_(std::chrono::steady_clock::now() - std::chrono::microseconds(session.now_us())),
      last_us_(session.now_us()),
      shown_(session.parts().size()) {
  planning_.study = &session;
  planning_.turn_on(true);
  show_part();
}

/// The scene in the state of the part's condition, from above, as the thesis's sessions began.
void StudyDesk::show_part() {
  shown_ = session_.index();
  texts_.clear();
  const study::Part* part = session_.part();
  if (!part || !part->task) return;
  Visit& visit = planning_.visit();
  if (study::scene_of(session_.study(), *part) != visit.scene().file) {
    has_ended_ = true;
    return;
  }
  planning_.tell(study::show_condition(visit.stage().simulation(), session_.study(), *part));
  if (const scene::NamedCamera* plan = visit.scene().find_camera("plan"))
    visit.navigation().go_to(plan->camera);
  session_.note("view", "plan");
}

void StudyDesk::begin_frame() {
  session_.pass(
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - began_)
          .count());
  if (session_.index() != shown_) show_part();
}

void StudyDesk::add_frame(double frame_s) {
  if (has_ended_) return;  // the next scene has begun in the log
  Visit& visit = planning_.visit();
  stage::Simulation& simulation = visit.stage().simulation();
  study::Frame frame{0, visit.advanced_s(), float(1e3 * frame_s), visit.camera(), {}};
  if (const planner::Tool* tool = planning_.tool(); tool && tool->place())
    frame.wand = glm::vec3(*tool->place());
  study::adapt_to(simulation, frame.eye);
  session_.note_frame(std::move(frame));
  if (study::is_state_due(std::exchange(last_us_, session_.now_us()), session_.now_us()))
    session_.note("state", study::state_text(study::state_of(simulation, *planning_.session())));
  if (session_.trouble() != told_trouble_ && !session_.trouble().empty())
    visit.notice_error(session_.trouble());
  told_trouble_ = session_.trouble();
}

bool StudyDesk::button(const char* name) {
  const bool is_pressed = ImGui::Button((word(name) + "##" + name).c_str());
  places_[name] = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
  return is_pressed;
}

void StudyDesk::draw(float picture_width) {
  places_.clear();
  if (!session_.part())
    draw_thanks(picture_width);
  else if (session_.part()->task)
    draw_instruction(picture_width);
  else
    draw_questions(picture_width);
}

void StudyDesk::draw_instruction(float width) {
  const study::Part& part = *session_.part();
  const design::Language language = planning_.language();
  ImGui::SetNextWindowPos({0.5f * width, 46.0f * imgui_.scale()}, ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowBgAlpha(0.9f);
  ImGui::Begin("instruction", nullptr, desk_flags | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushTextWrapPos(std::min(instruction_width * imgui_.scale(), 0.7f * width));
  if (session_.index() == 0 && !session_.study().welcome.english.empty())
    ImGui::TextUnformatted(session_.study().welcome.in(language).c_str());
  ImGui::PushFont(imgui_.fonts().heading);
  ImGui::TextUnformatted(part.task->instruction.in(language).c_str());
  ImGui::PopFont();
  ImGui::PopTextWrapPos();
  if (button("Done")) session_.finish_part();
  ImGui::SameLine();
  // Of conditions nothing is said.
  std::string said = fmt::format("{} {} / {}", word("Part"), session_.index() + 1, session_.parts().size());
  if (const auto left_s = session_.left_s())
    said += fmt::format("   {} {}", word("time left"), clock_text(*left_s));
  ImGui::TextColored(dim_text, "%s", said.c_str());
  ImGui::End();
}

void StudyDesk::draw_question(const study::Questionnaire& questionnaire, const study::Question& question) {
  const design::Language language = planning_.language();
  const std::string key = questionnaire.name + "." + question.name;
  const auto answered = session_.answers().find(key);
  const std::string answer = answered == session_.answers().end() ? "" : answered->second;
  ImGui::PushID(key.c_str());
  ImGui::TextUnformatted(question.text.in(language).c_str());
  if (question.is_text()) {
    std::string& text = texts_.try_emplace(key, answer).first->second;
    ImGui::InputTextMultiline("##text", &text, {-1.0f, 3.2f * ImGui::GetTextLineHeight()});
    if (ImGui::IsItemDeactivatedAfterEdit())
      planning_.tell(session_.answer(questionnaire.name, question.name, text));
  } else {
    ImGui::TextColored(dim_text, "%s", question.low_label.in(language).c_str());
    for (int value = question.low; value <= question.high; ++value) {
      ImGui::SameLine();
      const std::string label = fmt::format("{}", value);
      const bool is_pressed = ImGui::RadioButton(label.c_str(), answer == label);
      places_[key + "=" + label] = {ImGui::GetItemRectMin(), ImGui::GetItemRectMax()};
      if (is_pressed) planning_.tell(session_.answer(questionnaire.name, question.name, label));
    }
    ImGui::SameLine();
    ImGui::TextColored(dim_text, "%s", question.high_label.in(language).c_str());
  }
  ImGui::PopID();
  ImGui::Spacing();
}

void StudyDesk::draw_questions(float width) {
  const float height = ImGui::GetIO().DisplaySize.y;
  const float own_width = std::min(questions_width * imgui_.scale(), 0.9f * width);
  ImGui::SetNextWindowPos({0.5f * width, 0.5f * height}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({own_width, 0.86f * height});
  ImGui::Begin("questions", nullptr, desk_flags & ~ImGuiWindowFlags_AlwaysAutoResize);
  const float footer = ImGui::GetFrameHeightWithSpacing() + ImGui::GetStyle().ItemSpacing.y;
  ImGui::BeginChild("page", {0.0f, -footer});
  ImGui::PushTextWrapPos(0.0f);
  for (const std::string& name : session_.part()->asked) {
    const study::Questionnaire& questionnaire = session_.study().questionnaire(name);
    ImGui::PushFont(imgui_.fonts().heading);
    ImGui::TextUnformatted(questionnaire.title.in(planning_.language()).c_str());
    ImGui::PopFont();
    for (const study::Question& question : questionnaire.questions) draw_question(questionnaire, question);
  }
  ImGui::PopTextWrapPos();
  ImGui::EndChild();
  const bool is_pressed = button("Next");
  ImGui::SameLine();
  ImGui::TextColored(dim_text, "%s", word("You may leave a question out.").c_str());
  ImGui::End();
  if (is_pressed) session_.finish_part();
}

void StudyDesk::draw_thanks(float width) {
  ImGui::SetNextWindowPos({0.5f * width, 0.5f * ImGui::GetIO().DisplaySize.y}, ImGuiCond_Always,
                          {0.5f, 0.5f});
  ImGui::Begin("thanks", nullptr, desk_flags);
  ImGui::PushFont(imgui_.fonts().heading);
  const std::string& thanks = session_.study().thanks.in(planning_.language());
  ImGui::TextUnformatted(thanks.empty() ? word("Thank you.").c_str() : thanks.c_str());
  ImGui::PopFont();
  if (button("Close")) has_ended_ = true;
  ImGui::End();
}

}  // namespace parvis::viewer
