#include "planning/study/measures.h"

#include <algorithm>

#include "base/median.h"
#include "base/plan_polygon.h"
#include "planning/design/command.h"
#include "planning/study/session.h"
#include "scene/script/schema.h"

namespace parvis::study {
namespace {

/// Where a command puts new things.
std::vector<glm::dvec2> placed_by(const std::string& text) {
  const Result<design::Command> command = design::parse_command(text);
  if (!command) return {};
  if (const auto* insert = std::get_if<design::Insert>(&*command)) return {glm::dvec2(insert->position)};
  const auto* row = std::get_if<design::Row>(&*command);
  if (!row) return {};
  const double length_m = glm::distance(row->from, row->to);
  const int count = row->count > 0 ? row->count : 1 + int(length_m / std::max(row->spacing_m, 1e-3));
  std::vector<glm::dvec2> places;
  for (int i = 0; i < count; ++i)
    places.push_back(glm::mix(row->from, row->to, count > 1 ? double(i) / double(count - 1) : 0.0));
  return places;
}

void add_command(const std::string& text, double since_s, const Task* task, PartMeasures& part) {
  ++part.commands;
  if (text == "undo") ++part.undone;
  for (const glm::dvec2 place : placed_by(text)) {
    if (!part.first_placing_s) part.first_placing_s = since_s;
    part.placings.push_back(place);
    if (task && !task->area.empty() && !is_in_ring(task->area, place)) ++part.outside;
  }
}

}  // namespace

std::vector<PartMeasures> measures_of(const Study& study, const LoggedSession& session,
                                      const std::vector<Record>& records) {
  const Orders orders = study.orders();
  const std::vector<Part> parts = parts_of(study, orders[std::size_t(session.row) % orders.size()]);
  std::vector<PartMeasures> all;
  std::vector<float> frames_ms;
  std::string view = "first";
  const Task* task = nullptr;
  std::int64_t began_us = 0;
  std::optional<glm::dvec2> last;
  const auto end_part = [&](std::int64_t at_us, bool is_whole) {
    if (all.empty() || all.back().is_whole) return;
    all.back().duration_s = 1e-6 * double(at_us - began_us), all.back().is_whole = is_whole;
    all.back().median_frame_ms = double(median(frames_ms));
  };
  for (const Record& record : records) {
    if (const Frame* frame = std::get_if<Frame>(&record)) {
      if (all.empty()) continue;
      PartMeasures& part = all.back();
      const glm::dvec2 at(frame->eye.position_in_world());
      part.view_s[view] += frame->step_s;
      if (last && !frame->eye.parallel) part.way_m += glm::distance(*last, at);
      if (!frame->eye.parallel) part.eyes.emplace_back(at, frame->step_s);
      last = frame->eye.parallel ? std::nullopt : std::optional(at);
      if (frame->frame_ms > 0.0f) frames_ms.push_back(frame->frame_ms);
      continue;
    }
    const Event& event = std::get<Event>(record);
    if (const auto index = part_of(event, parts.size())) {
      end_part(event.time_us, true);
      const Part& begun = parts[*index];
      task = begun.task, began_us = event.time_us, frames_ms.clear(), last.reset();
      PartMeasures part;
      part.participant = session.participant, part.index = *index;
      part.task = begun.task ? begun.task->name : "questions";
      part.condition = begun.condition >= 0 ? study.conditions[std::size_t(begun.condition)].name : "-";
      part.position = begun.number;
      all.push_back(std::move(part));
    }
    if (all.empty()) continue;
    if (event.kind == "end") end_part(event.time_us, true);
    if (event.kind == "view") view = event.text, last.reset();  // a change of view is no way
    if (event.kind == "time over") all.back().is_time_over = true;
    if (event.kind == "refused") ++all.back().refused;
    if (event.kind == "command")
      add_command(event.text, 1e-6 * double(event.time_us - began_us), task, all.back());
    if (event.kind == "answer") {
      const auto [name, value] = first_word(event.text);
      all.back().answers[name] = value;
    }
  }
  if (!records.empty()) end_part(time_of(records.back()), false);
  return all;
}

std::vector<SusAnswer> sus_answers(const Questionnaire& questionnaire,
                                   const std::map<std::string, std::string>& answers) {
  std::vector<SusAnswer> made;
  for (const Question& question : questionnaire.questions) {
    const auto found = answers.find(questionnaire.name + "." + question.name);
    const std::vector<double> number =
        found == answers.end() ? std::vector<double>() : scene::parse_numbers(found->second);
    made.push_back(number.size() == 1 ? SusAnswer(number[0]) : SusAnswer());
  }
  return made;
}

}  // namespace parvis::study
