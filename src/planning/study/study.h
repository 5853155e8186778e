// A study as its script describes it: tasks in a scene, conditions under which they are done, questionnaires.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>

#include "planning/study/orders.h"
#include "planning/study/questionnaire.h"

namespace parvis::study {

/// A state of the scene that participants do not hear about.
struct Condition {
  std::string name, scenario;  ///< an empty scenario: the base scene
};

/// Something to be done in a scene.
struct Task {
  std::string name;
  Text instruction;
  double limit_s = 0.0;            ///< after which it ends by itself; 0: no limit
  std::vector<glm::dvec2> area;    ///< in which things are to be placed; empty: anywhere
  std::vector<std::string> asked;  ///< questionnaires after it
  std::filesystem::path scene;     ///< of a training; empty: the study's
};

/// A study.
struct Study {
  std::string name;
  std::filesystem::path file, scene;
  std::string script;  ///< its text, as it was read
  Text welcome, thanks;
  bool is_balanced = false;  ///< each participant has an own order of conditions; else as written
  std::vector<Task> trainings, tasks;
  std::vector<Condition> conditions;
  std::vector<std::string> asked;             ///< questionnaires at the end
  std::vector<Questionnaire> questionnaires;  ///< its own and the program's

  /// The questionnaire of that name, which the study asks.
  const Questionnaire& questionnaire(const std::string& of_name) const;
  /// The orders of its conditions, one for each participant in turn.
  Orders orders() const;
};

/// A part of a session: a task, or questions.
struct Part {
  const Task* task = nullptr;  ///< null: questions
  bool is_training = false;
  int condition = -1;                   ///< of the study; -1: none
  std::vector<std::string> asked = {};  ///< questionnaires, of questions
  int number = 0;                       ///< of a task among the tasks, from 1
};

/// The parts of a session whose conditions come in this order. The study outlives them.
std::vector<Part> parts_of(const Study& study, const std::vector<int>& order);

/// The scene of a part; of questions, the study's.
const std::filesystem::path& scene_of(const Study& study, const Part& part);

/// Reads a script of a study. Every error is reported with line and column; the scenes must be there, and are
/// not opened.
Result<Study> read_study(const std::filesystem::path& file);

}  // namespace parvis::study
