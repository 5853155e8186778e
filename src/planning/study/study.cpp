#include "planning/study/study.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>

#include "base/files.h"
#include "base/known_names.h"
#include "scene/script/attribute.h"
#include "scene/script/script_checker.h"

namespace parvis::study {

/// questionnaires.xp, embedded by CMakeLists.txt.
extern const char* const shipped_questionnaires_text;

namespace {

using namespace scene::attribute;
using scene::Node;

constexpr std::uint64_t max_study_bytes = 4u << 20;

/// A text and its French translation.
void add_text(std::vector<scene::AttributeSchema>& attributes, const std::string& name,
              const std::string& help) {
  attributes.push_back(text(name, help));
  attributes.push_back(text(name + "_fr", "the same in French"));
}

scene::NodeSchema study_schema() {
  scene::NodeSchema schema{
      .type = "study",
      .help =
          "A study: the tasks that participants do in a scene, one after another, and what they are asked.",
      .attributes = {text("name", "of the study").required(),
                     file("scene", "in which the tasks are done").required(),
                     choice(
                         "order",
                         "of conditions: given: as they are written; balanced: of each participant another "
                         "row of a balanced Latin square",
                         {"given", "balanced"})
                         .by_default("given"),
                     text("asked", "questionnaires at the end, names separated by spaces")},
      .stands_in = {scene::top_level},
      .is_unique = true};
  add_text(schema.attributes, "welcome", "what is said before the first part");
  add_text(schema.attributes, "thanks", "what is said after the last part");
  return schema;
}

scene::NodeSchema task_schema(const char* type, const char* help) {
  scene::NodeSchema schema{
      .type = type,
      .help = help,
      .attributes =
          {text("name", "in logs and reports").required(),
           number("minutes", "after which it ends by itself; 0: no limit").between(0, 600).by_default("0"),
           points("area", "corners of the part of the scene in which things are to be placed"),
           text("asked", "questionnaires after it, names separated by spaces")},
      .stands_in = {"study"}};
  add_text(schema.attributes, "instruction", "what stands on the screen");
  return schema;
}

scene::NodeSchema training_schema() {
  scene::NodeSchema schema =
      task_schema("training", "A task that comes first, in a scene of its own, and does not count.");
  schema.attributes.push_back(file("scene", "in which it is done").required());
  return schema;
}

scene::NodeSchema condition_schema() {
  return {.type = "condition",
          .help =
              "A state of the scene under which a task is done; participants do not hear of it. A study of "
              "one task "
              "has it done under each condition, one of as many tasks as conditions gives each task one.",
          .attributes = {text("name", "in logs and reports").required(),
                         text("scenario", "of the scene; empty: the base scene")},
          .stands_in = {"study"}};
}

scene::NodeSchema questionnaire_schema() {
  scene::NodeSchema schema{
      .type = "questionnaire",
      .help = "Questions that are asked together, with answers on one scale.",
      .attributes = {text("name", "by which it is asked").required(),
                     choice("score", "sus: ten items of the System Usability Scale", {"none", "sus"})
                         .by_default("none"),
                     integer("low", "end of the scale").between(0, 100).by_default("1"),
                     integer("high", "end of the scale").between(1, 100).by_default("7")},
      .stands_in = {scene::top_level, "study"}};
  for (const char* name : {"title", "low_label", "high_label"})
    add_text(schema.attributes, name,
             name == std::string("title") ? "above the questions" : "at that end of the scale");
  return schema;
}

scene::NodeSchema question_schema() {
  scene::NodeSchema schema{.type = "question",
                           .help = "A question of a questionnaire.",
                           .attributes = {text("item", "its name in logs and reports").required(),
                                          flag("free", "it is answered by a text").by_default("0")},
                           .stands_in = {"questionnaire"}};
  add_text(schema.attributes, "text", "what is asked");
  return schema;
}

const scene::NodeRegistry& study_registry() {
  static const scene::NodeRegistry registry = [] {
    scene::NodeRegistry made;
    made.add_part(study_schema());
    made.add_part(training_schema());
    made.add_part(task_schema("task", "A task of a study, in its scene."));
    made.add_part(condition_schema());
    made.add_part(questionnaire_schema());
    made.add_part(question_schema());
    return made;
  }();
  return registry;
}

Text text_of(const Node& node, const std::string& name) { return {node.text(name), node.text(name + "_fr")}; }

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t at = text.find_first_not_of(' '); at != std::string::npos;
       at = text.find_first_not_of(' ', at)) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    words.push_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

/// Names are columns of tables and words of input files.
bool is_word(const std::string& name) {
  return !name.empty() && name.size() <= 40 &&
         std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

Questionnaire questionnaire_of(const Node& node, Errors& errors) {
  Questionnaire made{node.text("name"), text_of(node, "title"), node.text("score") == "sus", {}};
  const int low = int(node.integer("low")), high = int(node.integer("high"));
  if (low >= high)
    errors.push_back(
        error_at(node.where, "questionnaire \"{}\": low={} is not below high={}", made.name, low, high));
  for (const Node& child : node.children) {
    Question question{child.text("item"),         text_of(child, "text"),     low, high,
                      text_of(node, "low_label"), text_of(node, "high_label")};
    if (child.flag("free")) question.high = question.low;
    if (made.find(question.name))
      errors.push_back(
          error_at(child.where, "questionnaire \"{}\" has two questions \"{}\"", made.name, question.name));
    if (!is_word(question.name))
      errors.push_back(
          error_at(child.where_of("item"), "\"{}\": names are letters, digits, _ and -", question.name));
    made.questions.push_back(std::move(question));
  }
  const bool fits_sus = made.questions.size() == 10 && low == 1 && high == 5 &&
                        std::ranges::none_of(made.questions, &Question::is_text);
  if (made.is_sus && !fits_sus)
    errors.push_back(error_at(node.where, "score=sus needs ten questions on a scale from 1 to 5"));
  return made;
}

const std::vector<Questionnaire>& shipped_questionnaires() {
  static const std::vector<Questionnaire> questionnaires = [] {
    const Result<scene::Nodes> nodes = scene::check_piece(shipped_questionnaires_text, "questionnaires.xp",
                                                          scene::top_level, {}, study_registry(), Roots(""));
    assert(nodes && "the questionnaires are a script");
    std::vector<Questionnaire> made;
    Errors errors;
    for (const Node& node : *nodes) made.push_back(questionnaire_of(node, errors));
    assert(errors.empty());
    return made;
  }();
  return questionnaires;
}

Task task_of(const Node& node) {
  Task task{node.text("name"), text_of(node, "instruction"), 60.0 * node.number("minutes"), {}, {}, {}};
  task.asked = words_of(node.text("asked"));
  for (const glm::vec3& corner : node.points("area")) task.area.emplace_back(corner);
  if (node.schema->type == "training") task.scene = node.file("scene");
  return task;
}

/// Errors of names that are no words.
template <class Things>
void check_words(const Things& things, const FileLocation& where, Errors& errors) {
  for (const auto& thing : things)
    if (!is_word(thing.name))
      errors.push_back(error_at(where, "\"{}\": names are letters, digits, _ and -", thing.name));
}

Study study_of(const Node& root, const scene::Nodes& nodes, Errors& errors) {
  Study study;
  study.name = root.text("name"), study.scene = root.file("scene");
  study.welcome = text_of(root, "welcome"), study.thanks = text_of(root, "thanks");
  study.is_balanced = root.text("order") == "balanced";
  study.asked = words_of(root.text("asked"));
  const auto read_questionnaires = [&](const scene::Nodes& among) {
    for (const Node& node : among)
      if (node.schema->type == "questionnaire")
        study.questionnaires.push_back(questionnaire_of(node, errors));
  };
  read_questionnaires(nodes);
  read_questionnaires(root.children);
  for (const Questionnaire& each : shipped_questionnaires())
    if (std::ranges::none_of(study.questionnaires, [&](const auto& own) { return own.name == each.name; }))
      study.questionnaires.push_back(each);
  std::map<std::string, FileLocation> asked;
  const auto note = [&](const std::vector<std::string>& names, const Node& node) {
    for (const std::string& name : names) asked.emplace(name, node.where_of("asked"));
  };
  note(study.asked, root);
  for (const Node& node : root.children) {
    const std::string& type = node.schema->type;
    if (type == "condition")
      study.conditions.push_back({node.text("name"), node.text("scenario")});
    else if (type == "task" || type == "training") {
      (type == "task" ? study.tasks : study.trainings).push_back(task_of(node));
      note(words_of(node.text("asked")), node);
      if (const std::size_t corners = node.points("area").size(); corners == 1 || corners == 2)
        errors.push_back(error_at(node.where_of("area"), "an area has at least three corners"));
    }
  }
  std::vector<std::string> known;
  for (const Questionnaire& each : study.questionnaires) known.push_back(each.name);
  for (const auto& [name, where] : asked)
    if (std::ranges::find(known, name) == known.end())
      errors.push_back(error_at(where, "there is no questionnaire \"{}\"{}", name.substr(0, 40),
                                names_that_exist(name, known)));
  check_words(study.conditions, root.where, errors);
  check_words(study.questionnaires, root.where, errors);
  check_words(study.trainings, root.where, errors);
  check_words(study.tasks, root.where, errors);
  if (study.tasks.empty())
    errors.push_back(error_at(root.where, "the study has no task; add task(name=, instruction=) to it"));
  const std::size_t tasks = study.tasks.size(), conditions = study.conditions.size();
  if (tasks > 1 && conditions > 0 && tasks != conditions)
    errors.push_back(
        error_at(root.where,
                 "{} tasks and {} conditions; give one task, which is done under each condition, or as "
                 "many tasks as conditions",
                 tasks, conditions));
  constexpr std::size_t max_conditions = 100;
  if (conditions > max_conditions)
    errors.push_back(error_at(root.where, "{} conditions; {} at most", conditions, max_conditions));
  return study;
}

}  // namespace

const Questionnaire& Study::questionnaire(const std::string& of_name) const {
  const auto found = std::ranges::find(questionnaires, of_name, &Questionnaire::name);
  assert(found != questionnaires.end());
  return *found;
}

Orders Study::orders() const {
  if (is_balanced && !conditions.empty()) return balanced_orders(int(conditions.size()));
  std::vector<int> given(conditions.size());
  std::iota(given.begin(), given.end(), 0);
  return {given};
}

std::vector<Part> parts_of(const Study& study, const std::vector<int>& order) {
  std::vector<Part> parts;
  const auto add = [&](const Task& task, bool is_training, int condition, int number) {
    parts.push_back({&task, is_training, condition, {}, number});
    if (!task.asked.empty()) parts.push_back({nullptr, is_training, condition, task.asked, number});
  };
  for (const Task& training : study.trainings) add(training, true, -1, 0);
  const std::size_t count = std::max(study.tasks.size(), order.size());
  for (std::size_t i = 0; i < count; ++i)
    add(study.tasks[study.tasks.size() == 1 ? 0 : i], false, i < order.size() ? order[i] : -1, int(i) + 1);
  if (!study.asked.empty()) parts.push_back({nullptr, false, -1, study.asked, 0});
  return parts;
}

const std::filesystem::path& scene_of(const Study& study, const Part& part) {
  return part.task && !part.task->scene.empty() ? part.task->scene : study.scene;
}

Result<Study> read_study(const std::filesystem::path& file) {
  Result<std::string> script = read_file(file, max_study_bytes);
  if (!script) return script.errors();
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const Result<scene::Nodes> nodes =
      scene::check_piece(*script, file.string(), scene::top_level, {}, study_registry(), Roots(folder));
  if (!nodes) return nodes.errors();
  const auto root = std::ranges::find(*nodes, "study", [](const Node& node) { return node.schema->type; });
  if (root == nodes->end())
    return error_at({file.string(), 1, 1}, "the script has no study(name=, scene=) {{ ... }}");
  Errors errors;
  Study study = study_of(*root, *nodes, errors);
  if (!errors.empty()) return errors;
  study.file = file, study.script = *std::move(script);
  return study;
}

}  // namespace parvis::study
