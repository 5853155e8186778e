#include "planning/study/session.h"

#include <algorithm>
#include <charconv>

namespace parvis::study {
namespace {

constexpr std::int64_t flush_every_us = 1'000'000;  // a frame alone is not worth a write to the disk

}  // namespace

std::pair<std::string, std::string> first_word(const std::string& text) {
  const std::size_t first = std::min(text.find_first_not_of(" \t"), text.size());
  const std::size_t end = std::min(text.find_first_of(" \t", first), text.size());
  const std::size_t rest = std::min(text.find_first_not_of(" \t", end), text.size());
  return {text.substr(first, end - first), text.substr(rest)};
}

std::optional<std::size_t> part_of(const Event& event, std::size_t count) {
  if (event.kind != "part") return std::nullopt;
  std::size_t index = 0;
  const auto [end, code] = std::from_chars(event.text.data(), event.text.data() + event.text.size(), index);
  return code == std::errc() && index < count ? std::optional(index) : std::nullopt;
}

Session::Session(const Study& study, Log& log, int row) : study_(&study), log_(&log) {
  const Orders orders = study.orders();
  parts_ = parts_of(study, orders[std::size_t(row) % orders.size()]);
}

Result<Session> Session::begin(const Study& study, Log& log, const std::string& participant, double clock_s) {
  const Result<std::vector<LoggedSession>> earlier = log.sessions();
  if (!earlier) return earlier.errors();
  std::vector<int> taken(study.orders().size());
  for (const LoggedSession& each : *earlier)
    if (each.study == study.name) ++taken[std::size_t(each.row) % taken.size()];
  const int row = int(std::ranges::min_element(taken) - taken.begin());
  const Result<LoggedSession> logged = log.begin({0, participant, study.name, study.script, row, clock_s});
  if (!logged) return logged.errors();
  Session session(study, log, row);
  session.begin_part(0);
  return session;
}

Result<Session> Session::resume(const Study& study, Log& log, const std::string& participant,
                                std::vector<Record>& before) {
  const Result<std::optional<LoggedSession>> logged = log.session_of(participant);
  if (!logged) return logged.errors();
  if (!*logged)
    return error("{} has no session of \"{}\"; begin one without --resume", log.file().string(),
                 participant.substr(0, 40));
  if ((*logged)->script != study.script)
    return error("{}: the study has changed since {} began; put its script back to go on",
                 study.file.string(), participant);
  Result<std::vector<Record>> records = log.records((*logged)->id);
  if (!records) return records.errors();
  Session session(study, log, (*logged)->row);
  for (const Record& record : *records) {
    session.now_us_ = std::max(session.now_us_, time_of(record));
    const Event* event = std::get_if<Event>(&record);
    if (!event) continue;
    if (event->kind == "end")
      return error("the session of {} has ended; there is nothing to go on with", participant);
    if (event->kind == "answer") {
      const auto [name, value] = first_word(event->text);
      session.answers_[name] = value;
    }
    if (const auto index = part_of(*event, session.parts_.size())) {
      session.index_ = *index, session.part_began_us_ = event->time_us;
      session.answers_.clear();
    }
  }
  before = *std::move(records);
  if (Status status = log.resume(**logged); !status) return status.errors();
  session.flushed_us_ = session.now_us_;
  session.note("resumed", "");
  return session;
}

void Session::begin_part(std::size_t index) {
  index_ = index, part_began_us_ = now_us_;
  answers_.clear();
  if (const Part* begun = part()) {
    const std::string condition =
        begun->condition >= 0 ? study_->conditions[std::size_t(begun->condition)].name : "-";
    note("part", fmt::format("{} {} {}", index, begun->task ? begun->task->name : "questions", condition));
  } else {
    note("end", "");
  }
}

std::optional<double> Session::left_s() const {
  const Part* present = part();
  if (!present || !present->task || present->task->limit_s <= 0.0) return std::nullopt;
  return std::max(0.0, present->task->limit_s - 1e-6 * double(now_us_ - part_began_us_));
}

void Session::pass(std::int64_t now_us) {
  now_us_ = std::max(now_us_, now_us);
  if (left_s() != 0.0) return;
  note("time over", "");
  finish_part();
}

void Session::note(const std::string& kind, const std::string& text) {
  log_->add(Event{now_us_, kind, text});
  flush();
}

void Session::note_command(const std::string& text, const Status& done) {
  if (done)
    note("command", text);
  else
    note("refused", text + ": " + done.errors().front().message);
}

void Session::note_frame(Frame frame) {
  frame.time_us = now_us_;
  log_->add(std::move(frame));
  if (now_us_ - flushed_us_ >= flush_every_us) flush();
}

Status Session::answer(const std::string& questionnaire, const std::string& item, const std::string& value) {
  const Part* present = part();
  if (!present || std::ranges::find(present->asked, questionnaire) == present->asked.end())
    return error("the questionnaire \"{}\" is not asked now", questionnaire.substr(0, 40));
  const Question* question = study_->questionnaire(questionnaire).find(item);
  if (!question)
    return error("the questionnaire \"{}\" has no question \"{}\"", questionnaire, item.substr(0, 40));
  if (Status status = check_answer(*question, value); !status) return status;
  const std::string name = questionnaire + "." + item;
  answers_[name] = value;
  note("answer", name + " " + value);
  return Ok{};
}

void Session::finish_part() {
  if (part()) begin_part(index_ + 1);
}

void Session::flush() {
  flushed_us_ = now_us_;
  const Status status = log_->flush();
  trouble_ = status ? "" : to_string(status.errors());
}

}  // namespace parvis::study
