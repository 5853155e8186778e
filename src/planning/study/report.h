// The report of a study for those who read it, and its tables for those who compute on.
#pragma once

#include "planning/study/measures.h"

namespace parvis::study {

/// All that a report shows.
struct ReportInput {
  const Study& study;
  std::vector<PartMeasures> parts;            ///< of all sessions
  std::vector<std::vector<glm::dvec2>> plan;  ///< lines of the place, below the maps; may be empty
  bool is_blind = false;  ///< conditions are called A, B, C: who reads it does not know them
};

/// A page that stands alone: times, errors and views by condition and paired, maps over the plan, scores with
/// their intervals, free texts.
std::string report_html(const ReportInput& input);

/// The tables by their file names: parts.csv, answers.csv.
std::map<std::string, std::string> report_tables(const ReportInput& input);
/// Records of a session as tables: events.csv, frames.csv.
std::map<std::string, std::string> record_tables(const std::string& participant,
                                                 const std::vector<Record>& records);

/// A page with the questions at the end of a study, for those who answer in a browser. It saves a file of
/// inputs (performance.h), which `parvis study run --answers` takes.
std::string questionnaire_page(const Study& study, design::Language language);

}  // namespace parvis::study
