// A participant's way through the parts of a study, and what is logged of it. It knows no scene: the window
// and the script-driven run show the parts and say what happens.
#pragma once

#include <functional>
#include <map>

#include "planning/study/log.h"
#include "planning/study/study.h"

namespace parvis::study {

class Session {
 public:
  /// Begins a session with the participant's order of conditions: the row that fewest sessions of the log
  /// have. `clock_s`: LoggedSession::clock_s. Study and log outlive it. Errors: the code is none, or taken.
  static Result<Session> begin(const Study& study, Log& log, const std::string& participant, double clock_s);
  /// Goes on with a session that was interrupted; `before` becomes what was logged of it. Errors: there is
  /// none, it has ended, or the study's script has changed since.
  static Result<Session> resume(const Study& study, Log& log, const std::string& participant,
                                std::vector<Record>& before);

  const std::vector<Part>& parts() const { return parts_; }
  std::size_t index() const { return index_; }  ///< of the present part
  /// The present part; null: the session has ended.
  const Part* part() const { return index_ < parts_.size() ? &parts_[index_] : nullptr; }
  const Study& study() const { return *study_; }
  std::int64_t now_us() const { return now_us_; }  ///< since the session began
  /// Seconds that are left of the present task; none: it has no limit.
  std::optional<double> left_s() const;

  /// Sets the time, which never goes back, and ends a task whose time is over.
  void pass(std::int64_t now_us);
  /// Logs something that happened.
  void note(const std::string& kind, const std::string& text);
  /// Logs how a command of a design went; to be given to design::Session::set_witness.
  void note_command(const std::string& text, const Status& done);
  /// Logs a frame.
  void note_frame(Frame frame);
  /// Logs an answer; empty: the question was left out. Errors: the present part does not ask this, or the
  /// answer does not count.
  Status answer(const std::string& questionnaire, const std::string& item, const std::string& value);
  /// The answers of the present part by QUESTIONNAIRE.ITEM.
  const std::map<std::string, std::string>& answers() const { return answers_; }
  /// Ends the present part: the next one begins, or the session ends.
  void finish_part();
  /// Writes what is not yet on the disk.
  void flush();

  /// Why the log cannot be written at the moment; empty: it can, and all but the frames of the last second is
  /// on the disk.
  const std::string& trouble() const { return trouble_; }

 private:
  Session(const Study& study, Log& log, int row);
  void begin_part(std::size_t index);

  const Study* study_;
  Log* log_;
  std::vector<Part> parts_;
  std::size_t index_ = 0;
  std::int64_t now_us_ = 0, part_began_us_ = 0, flushed_us_ = 0;
  std::map<std::string, std::string> answers_;
  std::string trouble_;
};

/// The first word of a text, and the rest behind it.
std::pair<std::string, std::string> first_word(const std::string& text);

/// Numbers of the parts that the events "part" of a session begin, with their times.
std::optional<std::size_t> part_of(const Event& event, std::size_t count);

}  // namespace parvis::study
