// parvis study: a design task with participants: conditions, log, replay, questionnaires, report.
#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "base/files.h"
#include "base/image_io.h"
#include "base/known_names.h"
#include "commands.h"
#include "graphics/gl/context.h"
#include "planning/plan_drawing/scene_plan.h"
#include "planning/study/performance.h"
#include "planning/study/report.h"
#include "planning/study/xdf.h"
#include "scene_arguments.h"
#include "stage/film.h"
#include "viewer/window.h"
#include "window_surroundings.h"

namespace parvis {
namespace {

struct StudyArguments {
  std::filesystem::path task, log, output;
  std::string participant, language;     ///< an empty language: the locale's
  std::filesystem::path input, answers;  ///< of run
  bool resumes = false;
  std::string camera, size = "1280x720";  ///< of replay
  double speed = 1.0, at_s = -1.0;
  int frames_per_second = 30;
  std::filesystem::path csv, xdf;  ///< of report
  bool is_blind = false;
  int max_frames = 0;  ///< of the window
  std::string screenshot;

  void add_task(CLI::App& command) {
    command.add_option("task", task, "The study's script (.xp)")->required();
    command.add_option("--log", log, "The log of its sessions (default: beside the script, NAME.sqlite)");
  }
  void add_participant(CLI::App& command) {
    command.add_option("--participant", participant, "A code, as P7; nobody's name")->required();
  }
  void add_language(CLI::App& command) {
    command.add_option("--language", language, "Of instructions and questions (default: the locale's)")
        ->check(CLI::IsMember({"en", "fr"}));
  }
  design::Language chosen_language() const {
    return design::language_of(language.empty() ? locale() : language);
  }
  std::filesystem::path log_file() const {
    return log.empty() ? std::filesystem::path(task).replace_extension(".sqlite") : log;
  }
};

/// The session of --participant with its records.
Result<std::pair<study::LoggedSession, std::vector<study::Record>>> logged(const StudyArguments& arguments) {
  const Result<study::Log> log = study::Log::read(arguments.log_file());
  if (!log) return log.errors();
  const Result<std::vector<study::LoggedSession>> sessions = log->sessions();
  if (!sessions) return sessions.errors();
  std::vector<std::string> names;
  for (const study::LoggedSession& each : *sessions) {
    names.push_back(each.participant);
    if (each.participant != arguments.participant) continue;
    Result<std::vector<study::Record>> records = log->records(each.id);
    if (!records) return records.errors();
    return std::pair(each, *std::move(records));
  }
  return error("{} has no participant \"{}\"{}", log->file().string(), arguments.participant.substr(0, 40),
               names_that_exist(arguments.participant, names));
}

/// Answers that the page of questions has saved, for a session whose last questions are due or over.
Status take_answers(const StudyArguments& arguments, study::Session& session) {
  while (session.part() && session.index() + 1 < session.parts().size()) session.finish_part();
  const Result<std::string> text = read_file(arguments.answers, 4u << 20);
  if (!text) return text.errors();
  int number = 0;
  for (std::size_t at = 0; at < text->size();) {
    const std::size_t end = std::min(text->find('\n', at), text->size());
    const auto [time, rest] = study::first_word(text->substr(at, end - at));
    const auto [kind, answer] = study::first_word(rest);
    const auto [name, value] = study::first_word(answer);
    at = end + 1, ++number;
    if (time.empty()) continue;
    const std::size_t dot = std::min(name.find('.'), name.size());
    const Status status =
        kind == "answer"
            ? session.answer(name.substr(0, dot), name.substr(std::min(dot + 1, name.size())), value)
            : Status(error("expected: SECONDS answer QUESTIONNAIRE.ITEM VALUE"));
    if (!status)
      return error_at({arguments.answers.string(), number, 1}, "{}", status.errors().front().message);
  }
  session.finish_part();
  return Ok{};
}

/// The session's parts in a window, scene by scene.
Status show_study(const StudyArguments& arguments, study::Session& session, study::Performance& performance) {
  viewer::WindowOptions window;
  if (Status status = parse_size(arguments.size, window.width, window.height); !status) return status;
  window.title = session.study().name;
  window.language = arguments.chosen_language();
  window.kept_pictures = kept_pictures();
  window.max_frames = arguments.max_frames;
  if (window.max_frames > 0) window.sound = "off";
  window.always_holds_rate = arguments.max_frames == 0;
  window.screenshot = arguments.screenshot;
  window.study = &session;
  window.next_scene = [&]() -> Result<std::optional<stage::Simulation>> {
    if (!session.part()) return std::optional<stage::Simulation>();
    if (Status status = performance.begin(*session.part()); !status) return status.errors();
    return std::optional(performance.take());
  };
  Result<std::optional<stage::Simulation>> first = window.next_scene();
  if (!first) return first.errors();
  return viewer::show(**std::move(first), window);
}

double steady_clock_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Status run_study(const StudyArguments& arguments) {
  const Result<study::Study> read = study::read_study(arguments.task);
  if (!read) return read.errors();
  if (Status status = study::check_scenes(*read, rooms::all_registries()); !status) return status;
  Result<study::Log> log = study::Log::open(arguments.log_file());
  if (!log) return log.errors();
  std::vector<study::Record> before;
  Result<study::Session> session =
      arguments.resumes || !arguments.answers.empty()
          ? study::Session::resume(*read, *log, arguments.participant, before)
          : study::Session::begin(*read, *log, arguments.participant,
                                  arguments.input.empty() ? steady_clock_s() : 0.0);
  if (!session) return session.errors();
  if (!arguments.answers.empty()) {
    if (Status status = take_answers(arguments, *session); !status) return status;
  } else {
    study::Performance performance(*read, session->parts(), rooms::all_registries());
    if (arguments.resumes) {
      const Result<study::Replay> replayed = study::replay(performance, before);
      if (!replayed) return replayed.errors();
      if (Status status = performance.apply(study::Event{0, "resumed", ""}); !status) return status;
    }
    if (Status status = arguments.input.empty() ? show_study(arguments, *session, performance)
                                                : study::run_inputs(*session, performance, arguments.input);
        !status)
      return status;
  }
  session->flush();
  if (session->part())
    fmt::print("{}: {} is in part {} of {}; go on with --resume\n", log->file().string(),
               arguments.participant, session->index() + 1, session->parts().size());
  else
    fmt::print("{}: the session of {} has ended\n", log->file().string(), arguments.participant);
  if (!session->trouble().empty()) return error("{}", session->trouble());
  return Ok{};
}

/// Draws a replay: a film at some speed, or the picture of a moment.
class ReplayDrawing {
 public:
  static Result<ReplayDrawing> begin(const StudyArguments& arguments) {
    ReplayDrawing drawing(arguments);
    if (Status status = parse_size(arguments.size, drawing.size_.x, drawing.size_.y); !status)
      return status.errors();
    Result<gl::Context> context = gl::Context::create_headless();
    if (!context) return context.errors();
    drawing.context_.emplace(*std::move(context));
    if (arguments.output.extension() != ".mp4") return drawing;
    Result<stage::Film> film =
        stage::Film::open(arguments.output, drawing.size_.x, drawing.size_.y, arguments.frames_per_second);
    if (!film) return film.errors();
    drawing.film_.emplace(*std::move(film));
    return drawing;
  }

  Result<stage::Simulation*> keep(stage::Simulation simulation) {
    stage_.reset();
    Result<std::unique_ptr<stage::Stage>> made = stage::Stage::create(std::move(simulation));
    if (!made) return made.errors();
    stage_ = *std::move(made);
    return &stage_->simulation();
  }

  Status show(const study::Frame& frame) {
    const double time_s = 1e-6 * double(frame.time_us);
    if (!film_) {
      if (is_taken_ || time_s < arguments_->at_s) return Ok{};
      is_taken_ = true;
      Result<Image8> picture = draw(frame);
      return picture ? write_image(arguments_->output, *picture) : Status(picture.errors());
    }
    for (; next_s_ <= time_s; next_s_ += arguments_->speed / arguments_->frames_per_second) {
      const Result<Image8> picture = draw(frame);
      if (!picture) return picture.errors();
      if (Status status = film_->add(*picture); !status) return status;
    }
    return Ok{};
  }

  Status finish() {
    if (film_) return film_->finish();
    return is_taken_ ? Status(Ok{})
                     : Status(error("--at {}: the session was over by then", arguments_->at_s));
  }

 private:
  explicit ReplayDrawing(const StudyArguments& arguments) : arguments_(&arguments) {}

  Result<Image8> draw(const study::Frame& frame) {
    Camera camera = frame.eye;
    if (!arguments_->camera.empty()) {
      const Result<Camera> named = stage_->camera(arguments_->camera);
      if (!named) return named.errors();
      camera = *named;
    }
    stage_->draw(camera, size_.x, size_.y);
    return stage_->picture();
  }

  const StudyArguments* arguments_;
  glm::ivec2 size_{0};
  std::optional<gl::Context> context_;
  std::unique_ptr<stage::Stage> stage_;
  std::optional<stage::Film> film_;
  double next_s_ = 0.0;
  bool is_taken_ = false;
};

Status replay_study(const StudyArguments& arguments) {
  const Result<study::Study> read = study::read_study(arguments.task);
  if (!read) return read.errors();
  const auto session = logged(arguments);
  if (!session) return session.errors();
  if (session->first.script != read->script)
    return error("{}: the study has changed since {} took part; put its script back to replay",
                 arguments.task.string(), arguments.participant);
  const study::Orders orders = read->orders();
  const std::vector<study::Part> parts =
      study::parts_of(*read, orders[std::size_t(session->first.row) % orders.size()]);
  std::optional<ReplayDrawing> drawing;
  if (!arguments.output.empty()) {
    Result<ReplayDrawing> begun = ReplayDrawing::begin(arguments);
    if (!begun) return begun.errors();
    drawing.emplace(*std::move(begun));
  }
  study::Performance::Keep keep;
  if (drawing) keep = [&](stage::Simulation simulation) { return drawing->keep(std::move(simulation)); };
  study::Performance performance(*read, parts, rooms::all_registries(), keep);
  const Result<study::Replay> outcome = study::replay(
      performance, session->second,
      [&](const study::Frame& frame) -> Status { return drawing ? drawing->show(frame) : Status(Ok{}); });
  if (!outcome) return outcome.errors();
  if (drawing)
    if (Status status = drawing->finish(); !status) return status;
  if (outcome->differs_at_us)
    return error(
        "the replay differs from the session from {:.3f} s on: the scene or the program has changed since",
        1e-6 * double(*outcome->differs_at_us));
  fmt::print("{} frames, {} logged states: the same bits\n", outcome->frames, outcome->states);
  return Ok{};
}

/// The lines of the study's place, for maps. A place that cannot be read any more has none.
std::vector<std::vector<glm::dvec2>> plan_lines(const study::Study& study) {
  std::vector<std::vector<glm::dvec2>> lines;
  const Result<stage::Simulation> simulation =
      stage::open_simulation(rooms::all_registries(), study.scene, {});
  if (!simulation) {
    fmt::print(stderr, "warning: maps without a plan: {}\n", to_string(simulation.errors()));
    return lines;
  }
  for (const plan_drawing::PlanLine& line : plan_drawing::plan_of(simulation->scene, {}).lines) {
    if (line.layer == plan_drawing::PlanLayer::plant) continue;
    std::vector<glm::dvec2>& points = lines.emplace_back();
    for (const glm::dvec3& point : line.points) points.emplace_back(point);
  }
  return lines;
}

Status write_tables(const std::filesystem::path& folder, const std::map<std::string, std::string>& tables) {
  for (const auto& [name, text] : tables)
    if (Status status = write_file(folder / name, text); !status) return status;
  return Ok{};
}

Status report_study(const StudyArguments& arguments) {
  if (arguments.output.empty() && arguments.csv.empty() && arguments.xdf.empty())
    return error("nothing is asked for: give -o REPORT.html, --csv FOLDER or --xdf FOLDER");
  const Result<study::Study> read = study::read_study(arguments.task);
  if (!read) return read.errors();
  const Result<study::Log> log = study::Log::read(arguments.log_file());
  if (!log) return log.errors();
  const Result<std::vector<study::LoggedSession>> sessions = log->sessions();
  if (!sessions) return sessions.errors();
  study::ReportInput input{*read, {}, {}, arguments.is_blind};
  for (const study::LoggedSession& session : *sessions) {
    if (session.study != read->name) continue;
    const Result<std::vector<study::Record>> records = log->records(session.id);
    if (!records) return records.errors();
    const std::vector<study::PartMeasures> parts = study::measures_of(*read, session, *records);
    input.parts.insert(input.parts.end(), parts.begin(), parts.end());
    if (!arguments.csv.empty())
      if (Status status = write_tables(arguments.csv / session.participant,
                                       study::record_tables(session.participant, *records));
          !status)
        return status;
    if (!arguments.xdf.empty())
      if (Status status =
              write_file(arguments.xdf / (session.participant + ".xdf"), study::xdf_of(session, *records));
          !status)
        return status;
  }
  if (!arguments.csv.empty())
    if (Status status = write_tables(arguments.csv, study::report_tables(input)); !status) return status;
  if (!arguments.output.empty()) {
    input.plan = plan_lines(*read);
    if (Status status = write_file(arguments.output, study::report_html(input)); !status) return status;
  }
  fmt::print("{} sessions\n", sessions->size());
  return Ok{};
}

Status write_page(const StudyArguments& arguments) {
  const Result<study::Study> read = study::read_study(arguments.task);
  if (!read) return read.errors();
  if (read->asked.empty())
    return error("{}: the study asks nothing at its end (asked=)", arguments.task.string());
  return write_file(arguments.output, study::questionnaire_page(*read, arguments.chosen_language()));
}

Status forget_participant(const StudyArguments& arguments) {
  Result<study::Log> log = study::Log::read(arguments.log_file());
  if (!log) return log.errors();
  if (Status status = log->forget(arguments.participant); !status) return status;
  fmt::print("{}: {} is deleted\n", log->file().string(), arguments.participant);
  return Ok{};
}

}  // namespace

void add_study(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand(
      "study", "A design task with participants: conditions, log, replay, questionnaires, report");
  command->require_subcommand(1);
  command->footer("Example: parvis study run scenes/three_corners.study --participant P7");
  const auto arguments = std::make_shared<StudyArguments>();
  const auto add = [&](const char* name, const char* help, Status (*does)(const StudyArguments&)) {
    CLI::App* added = command->add_subcommand(name, help);
    arguments->add_task(*added);
    added->callback([arguments, does, &chosen] { chosen = [arguments, does] { return does(*arguments); }; });
    return added;
  };
  CLI::App* run = add("run", "A session of a participant", run_study);
  run->footer("Example: parvis study run scenes/three_corners.study --participant P1");
  arguments->add_participant(*run);
  arguments->add_language(*run);
  run->add_option("--input", arguments->input, "A file of inputs, one on each line, in place of a window");
  run->add_option("--answers", arguments->answers, "A file that the page of questions has saved");
  run->add_option("--size", arguments->size, "Width x height of the window in pixels")->capture_default_str();
  run->add_option("--frames", arguments->max_frames, "Close the window after so many frames")
      ->check(CLI::Range(0, 1000000));
  run->add_option("--screenshot", arguments->screenshot, "Write what the window shows last, when it closes");
  run->add_flag("--resume", arguments->resumes, "Go on with a session that was interrupted");
  CLI::App* replay =
      add("replay", "A session once more, bit by bit; as a film or a picture from any view", replay_study);
  replay->footer(
      "Example: parvis study replay scenes/three_corners.study --participant P1 --speed 8 -o p1.mp4");
  arguments->add_participant(*replay);
  replay->add_option("-o,--output", arguments->output, "A film (.mp4), or a picture (.png, .jpg) of --at");
  replay->add_option("--at", arguments->at_s, "Second of the session that the picture shows")
      ->check(CLI::Range(0.0, 86400.0));
  replay->add_option("--speed", arguments->speed, "Seconds of the session in a second of the film")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  replay->add_option("--camera", arguments->camera, "A camera of the scene (default: the participant's eye)");
  replay->add_option("--size", arguments->size, "Width x height in pixels")->capture_default_str();
  replay->add_option("--fps", arguments->frames_per_second, "Frames per second of the film")
      ->check(CLI::Range(1, 240))
      ->capture_default_str();
  CLI::App* report = add(
      "report", "All sessions by condition: a page with plots, tables, files for laboratories", report_study);
  report->footer(
      "Example: parvis study report scenes/three_corners.study -o report.html --csv tables --xdf xdf");
  report->add_option("-o,--output", arguments->output, "The page (.html)");
  report->add_option("--csv", arguments->csv,
                     "Folder for tables: parts, answers; events and frames of each session");
  report->add_option("--xdf", arguments->xdf, "Folder for an XDF file of each session (Lab Streaming Layer)");
  report->add_flag("--blind", arguments->is_blind, "Call the conditions A, B, C");
  CLI::App* page = add("page", "The questions at the study's end as a page for a browser", write_page);
  page->footer("Example: parvis study page scenes/three_corners.study --language fr -o questions.html");
  page->add_option("-o,--output", arguments->output, "The page (.html)")->required();
  arguments->add_language(*page);
  CLI::App* forget = add("forget", "Deletes a participant's session from the log", forget_participant);
  forget->footer("Example: parvis study forget scenes/three_corners.study --participant P1");
  arguments->add_participant(*forget);
}

}  // namespace parvis
