// What a log says about how participants worked: times, errors, views, ways and answers of each part.
#pragma once

#include <map>

#include "planning/study/log.h"
#include "planning/study/study.h"

namespace parvis::study {

/// One part of one session.
struct PartMeasures {
  std::string participant;
  std::size_t index = 0;  ///< of the part in the session
  std::string task;       ///< "questions" of questions
  std::string condition;  ///< "-": none
  int position = 0;       ///< of the task among those that count, from 1; 0: training and the last questions
  bool is_whole = false;  ///< it was ended; else the session was interrupted in it
  bool is_time_over = false;
  double duration_s = 0.0;
  std::optional<double> first_placing_s;
  int commands = 0, undone = 0;
  int refused = 0;                             ///< commands that could not be done
  int outside = 0;                             ///< things placed outside of the task's area
  double way_m = 0.0;                          ///< of the eye, in plan
  std::map<std::string, double> view_s;        ///< how long it looked from each view
  std::vector<glm::dvec3> eyes;                ///< x, y and for how many seconds
  std::vector<glm::dvec2> placings;            ///< where things were put
  std::map<std::string, std::string> answers;  ///< by QUESTIONNAIRE.ITEM
  double median_frame_ms = 0.0;

  /// Errors: commands that could not be done, and things outside of the area.
  int errors() const { return refused + outside; }
  bool is_task() const { return task != "questions"; }
};

/// The parts of a session that were begun.
std::vector<PartMeasures> measures_of(const Study& study, const LoggedSession& session,
                                      const std::vector<Record>& records);

/// The answers of a System Usability Scale in the order of its items.
std::vector<SusAnswer> sus_answers(const Questionnaire& questionnaire,
                                   const std::map<std::string, std::string>& answers);

}  // namespace parvis::study
