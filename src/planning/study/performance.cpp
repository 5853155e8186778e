#include "planning/study/performance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/content_hash.h"
#include "base/files.h"
#include "base/known_names.h"
#include "planning/design/scene_surfaces.h"
#include "scene/script/scene_loader.h"
#include "scene/script/script_checker.h"

namespace parvis::study {
namespace {

constexpr std::int64_t frames_per_second = 60, state_every_us = 10'000'000;

std::int64_t frame_us(std::int64_t number) { return number * 1'000'000 / frames_per_second; }

/// A line of a file of inputs.
struct InputLine {
  double time_s = 0.0;
  std::string kind, text;
  int number = 0;
};

Result<std::vector<InputLine>> read_inputs(const std::filesystem::path& file) {
  constexpr std::uint64_t max_bytes = 64u << 20;
  const Result<std::string> text = read_file(file, max_bytes);
  if (!text) return text.errors();
  std::vector<InputLine> lines;
  int number = 0;
  for (std::size_t at = 0; at < text->size();) {
    const std::size_t end = std::min(text->find('\n', at), text->size());
    std::string line = text->substr(at, end - at);
    at = end + 1, ++number;
    if (line.ends_with('\r')) line.pop_back();
    const auto [time, rest] = first_word(line);
    if (time.empty() || time.starts_with('#')) continue;
    const std::vector<double> seconds = scene::parse_numbers(time);
    const auto [kind, what] = first_word(rest);
    constexpr double max_s = 86'400.0;
    if (seconds.size() != 1 || seconds[0] < 0.0 || seconds[0] > max_s)
      return error_at({file.string(), number, 1},
                      "\"{}\" is no time; a line is written: SECONDS WHAT ..., up to 86400",
                      time.substr(0, 40));
    if (!lines.empty() && seconds[0] < lines.back().time_s)
      return error_at({file.string(), number, 1},
                      "{} s comes after {} s; the lines stand in the order of their times",
                      time.substr(0, 40), lines.back().time_s);
    lines.push_back({seconds[0], kind, what, number});
  }
  return lines;
}

/// An eye as `eye` gives it.
Result<Camera> eye_of(const std::string& text) {
  const Result<design::Command> parsed = design::parse_command("view eye " + text);
  const auto* view = parsed ? std::get_if<design::KeepView>(&*parsed) : nullptr;
  if (!view) return error("an eye is written: X,Y,Z heading DEG pitch DEG [fov DEG | parallel M]");
  const float heading = glm::radians(float(view->heading_deg)), pitch = glm::radians(float(view->pitch_deg));
  const glm::vec3 level(std::sin(heading), std::cos(heading), 0.0f);
  const glm::vec3 ahead = std::cos(pitch) * level + glm::vec3(0.0f, 0.0f, std::sin(pitch));
  const glm::vec3 up = glm::vec3(0.0f, 0.0f, std::cos(pitch)) - std::sin(pitch) * level;
  Camera camera;
  camera.world_from_camera = look_at(glm::vec3(view->position), glm::vec3(view->position) + ahead, up);
  camera.vertical_fov = vertical_fov(glm::radians(float(view->fov_deg)), 16.0f / 9.0f);
  if (view->parallel_m) camera.parallel = ParallelView{float(*view->parallel_m), 300.0f};
  return camera;
}

/// One input. Errors: it cannot be read.
Status put_in(const InputLine& line, Session& session, Performance& performance, Camera& eye) {
  stage::Simulation& simulation = *performance.simulation();
  if (line.kind == "do") {
    static_cast<void>(performance.design()->run(line.text).ok());  // the witness logs how it went
  } else if (line.kind == "view") {
    const Result<Camera> camera = simulation.camera(line.text);
    if (!camera) return camera.errors();
    eye = *camera;
    session.note("view", line.text);
  } else if (line.kind == "eye") {
    const Result<Camera> camera = eye_of(line.text);
    if (!camera) return camera.errors();
    eye = *camera;
  } else if (line.kind == "press" || line.kind == "release") {
    if (!simulation.actions().uses_key(line.text))
      return error("nothing in the scene waits for the key \"{}\"", line.text.substr(0, 40));
    session.note(line.kind, line.text);
    return performance.apply(Event{session.now_us(), line.kind, line.text});
  } else if (line.kind == "note") {
    session.note("note", line.text);
  } else if (line.kind == "answer") {
    const auto [name, value] = first_word(line.text);
    const std::size_t dot = std::min(name.find('.'), name.size());
    return session.answer(name.substr(0, dot), name.substr(std::min(dot + 1, name.size())), value);
  } else if (line.kind == "done") {
    session.finish_part();
  } else {
    static const std::vector<std::string> kinds{"do",      "view", "eye",    "press",
                                                "release", "note", "answer", "done"};
    return error("\"{}\" is no input{}", line.kind.substr(0, 40), names_that_exist(line.kind, kinds));
  }
  return Ok{};
}

}  // namespace

Status show_condition(stage::Simulation& simulation, const Study& study, const Part& part) {
  if (part.condition < 0 || !part.task) return Ok{};
  const std::string& scenario = study.conditions[std::size_t(part.condition)].scenario;
  Status status = simulation.live().choose(simulation.scene, scenario);
  simulation.clock.follow(simulation.scene);
  return status;
}

std::uint64_t state_of(const stage::Simulation& simulation, const design::Session& design) {
  ContentHash hash;
  for (const scene::Object& object : simulation.scene.objects) {
    hash.add(object.world_from_model);
    hash.add(object.pose);
    hash.add(object.is_visible);
  }
  for (const scene::NamedCamera& each : simulation.scene.cameras) hash.add(each.camera.world_from_camera);
  hash.add(simulation.clock.time_s());
  hash.add_text(simulation.live().scenario());
  hash.add_text(design.script());
  return hash.value();
}

std::string state_text(std::uint64_t state) { return fmt::format("{:016x}", state); }

bool is_state_due(std::int64_t before_us, std::int64_t now_us) {
  return before_us / state_every_us != now_us / state_every_us;
}

void adapt_to(stage::Simulation& simulation, const Camera& eye) {
  const glm::vec3 place = eye.position_in_world();
  simulation.clock.adapt(simulation.scene, std::span(&place, 1));
}

Status check_scenes(const Study& study, const Registries& registries) {
  const auto& registry = registries.get<scene::NodeRegistry>();
  for (const Task& training : study.trainings)
    if (Status status = scene::check_scene(training.scene, registry); !status) return status;
  const Result<scene::Nodes> nodes =
      scene::check_script(study.scene, registry, Roots(study.scene.parent_path()));
  if (!nodes) return nodes.errors();
  std::vector<std::string> scenarios;
  for (const scene::Node& node : *nodes)
    if (node.schema->type == "scenario") scenarios.push_back(node.text("name"));
  for (const Condition& condition : study.conditions)
    if (!condition.scenario.empty() && std::ranges::find(scenarios, condition.scenario) == scenarios.end())
      return error("{}: the condition \"{}\" is shown by the scenario \"{}\", which {} does not have{}",
                   study.file.string(), condition.name, condition.scenario, study.scene.filename().string(),
                   names_that_exist(condition.scenario, scenarios));
  return Ok{};
}

Performance::Performance(const Study& study, const std::vector<Part>& parts, const Registries& registries,
                         Keep keep)
    : study_(study), parts_(parts), registries_(registries), keep_(std::move(keep)) {
  if (!keep_)
    keep_ = [this](stage::Simulation simulation) -> Result<stage::Simulation*> {
      kept_.emplace(std::move(simulation));
      return &*kept_;
    };
}

Status Performance::open_design() {
  Result<design::Session> opened = design::Session::open(simulation_->scene, simulation_->live(), "",
                                                         design::resting_heights(simulation_->scene));
  if (!opened) return opened.errors();
  design_.emplace(*std::move(opened));
  return Ok{};
}

Status Performance::begin(const Part& part) {
  const std::filesystem::path& scene = scene_of(study_, part);
  if (!simulation_ || (scene != open_ && part.task)) {
    design_.reset(), simulation_ = nullptr;
    Result<stage::Simulation> opened = stage::open_simulation(registries_, scene, {});
    if (!opened) return opened.errors();
    const Result<stage::Simulation*> kept = keep_(*std::move(opened));
    if (!kept) return kept.errors();
    simulation_ = *kept, open_ = scene;
    eye_.reset();
    if (Status status = open_design(); !status) return status;
  }
  return show_condition(*simulation_, study_, part);
}

Status Performance::apply(const Record& record) {
  if (const Frame* frame = std::get_if<Frame>(&record)) {
    if (!simulation_) return Ok{};
    simulation_->advance(frame->step_s, eye_.value_or(frame->eye.position_in_world()));
    adapt_to(*simulation_, frame->eye);
    eye_ = frame->eye.position_in_world();
    return Ok{};
  }
  const Event& event = std::get<Event>(record);
  if (const auto index = part_of(event, parts_.size())) return begin(parts_[*index]);
  if (!simulation_) return Ok{};
  if (event.kind == "command") static_cast<void>(design_->run(event.text).ok());
  if (event.kind == "press") simulation_->actions().press(event.text);
  if (event.kind == "release") simulation_->actions().release(event.text);
  if (event.kind == "resumed") return open_design();  // its steps were gone then
  return Ok{};
}

stage::Simulation Performance::take() {
  design_.reset();
  return std::move(*std::exchange(simulation_, nullptr));
}

Result<Replay> replay(Performance& performance, const std::vector<Record>& records,
                      const std::function<Status(const Frame&)>& shown) {
  Replay outcome;
  for (const Record& record : records) {
    if (Status status = performance.apply(record); !status) return status.errors();
    if (const Frame* frame = std::get_if<Frame>(&record)) {
      ++outcome.frames;
      if (shown)
        if (Status status = shown(*frame); !status) return status.errors();
      continue;
    }
    const Event& event = std::get<Event>(record);
    if (event.kind != "state" || !performance.simulation()) continue;
    ++outcome.states;
    const std::uint64_t state = state_of(*performance.simulation(), *performance.design());
    if (state_text(state) != event.text && !outcome.differs_at_us) outcome.differs_at_us = event.time_us;
  }
  return outcome;
}

Status run_inputs(Session& session, Performance& performance, const std::filesystem::path& inputs) {
  const Result<std::vector<InputLine>> lines = read_inputs(inputs);
  if (!lines) return lines.errors();
  // The part whose scene is shown: none, or where a session goes on, the present one.
  std::size_t shown = performance.simulation() ? session.index() : session.parts().size();
  const auto watch = [&] {
    performance.design()->set_witness(
        [&session](const std::string& text, const Status& done) { session.note_command(text, done); });
  };
  const auto show = [&]() -> Status {
    if (!session.part() || shown == session.index()) return Ok{};
    shown = session.index();
    if (Status status = performance.begin(*session.part()); !status) return status;
    watch();
    return Ok{};
  };
  const auto note_state = [&] {
    session.note("state", state_text(state_of(*performance.simulation(), *performance.design())));
  };
  if (Status status = show(); !status) return status;
  watch();
  Result<Camera> eye = performance.simulation()->camera("");
  if (!eye) return eye.errors();
  std::int64_t frame = session.now_us() * frames_per_second / 1'000'000;
  for (const InputLine& line : *lines) {
    const auto due_us = std::int64_t(1e6 * line.time_s);
    while (session.part() && frame_us(frame + 1) <= due_us) {
      ++frame;
      const std::int64_t before_us = session.now_us();
      session.pass(frame_us(frame));
      if (Status status = show(); !status) return status;
      Frame step{session.now_us(), 1.0 / double(frames_per_second), 0.0f, *eye, {}};
      if (Status status = performance.apply(step); !status) return status;
      session.note_frame(std::move(step));
      if (is_state_due(before_us, session.now_us())) note_state();
    }
    if (!session.part()) break;
    session.pass(due_us);
    if (Status status = show(); !status) return status;
    if (!session.part()) break;
    if (line.kind == "done") note_state();
    if (const Status put = put_in(line, session, performance, *eye); !put) {
      session.flush();
      return error_at({inputs.string(), line.number, 1}, "{}", put.errors().front().message);
    }
    if (Status status = show(); !status) return status;
  }
  session.flush();
  return Ok{};
}

}  // namespace parvis::study
