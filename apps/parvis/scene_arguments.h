// The arguments that every command on a scene has.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/known_names.h"
#include "base/memory_budget.h"
#include "base/result.h"
#include "places/dressing/bare_file.h"
#include "rooms/rooms.h"
#include "stage/stage.h"
#include "strict_numbers.h"

namespace parvis {

/// --max-memory.
inline void add_max_memory(CLI::App& command) {
  command
      .add_option_function<double>(
          "--max-memory", [](double gigabytes) { set_max_memory(std::uint64_t(1e9 * gigabytes)); },
          "Memory that the scene may take, in GB (default: half of the machine's)")
      ->check(CLI::Range(0.1, 1e6));
}

/// Where `scene` names a model file instead of a script: writes a script that shows it into the working
/// folder, says so, and names that script instead.
inline Status describe_bare_file(std::filesystem::path& scene, std::vector<std::filesystem::path>& data) {
  for (const std::filesystem::path& folder : data)
    if (const std::string missing = missing_folder(folder); !missing.empty())
      fmt::print(stderr, "warning: --data {}: {}\n", folder.string(), missing);
  if (!dressing::is_bare_file(scene)) return Ok{};
  const Result<dressing::WrittenScene> written =
      dressing::write_bare_scene(scene, rooms::all_registries().get<formats::Readers>(), ".");
  if (!written) return written.errors();
  const std::string with_data =
      written->data_folder.empty() ? "" : fmt::format(" --data \"{}\"", written->data_folder.string());
  fmt::print(stderr, "{}: {}; edit it, and: parvis view {}{}\n", written->script.string(),
             written->is_new ? "the scene made up for this file" : "the scene that was made up before",
             written->script.string(), with_data);
  if (!written->data_folder.empty()) data.push_back(written->data_folder);
  scene = written->script;
  return Ok{};
}

struct SceneArguments {
  std::filesystem::path scene;
  std::vector<std::filesystem::path> data;
  std::string camera;
  std::string size = "1280x720";
  double time_s = 0.0;
  std::string method;
  std::optional<double> realism;       ///< none: the scene's own
  std::vector<std::string> scenarios;  ///< none: as the scene begins
  std::vector<std::string> presses;    ///< "KEY@SECONDS"
  std::string tour;

  /// SCENE and --data.
  void add_scene(CLI::App& command) {
    command.add_option("scene", scene, "The scene's script (.xp), or a model file to be shown by itself")
        ->required();
    command.add_option("--data", data, "A further folder that the scene may read from");
    add_max_memory(command);
  }
  /// --camera.
  void add_camera(CLI::App& command) {
    command.add_option("--camera", camera, "Name of the camera (default: the scene's first)");
  }
  /// --scenario and --time.
  void add_state(CLI::App& command) {
    command.add_option("--scenario", scenarios, "A state that the scene gives by this name; base: none");
    command.add_option("--time", time_s, "Seconds that have passed in the scene before")
        ->check(CLI::Range(0.0, 86400.0));
  }
  /// --scenario, --size, --time, --press and --reflection.
  void add_picture(CLI::App& command) {
    add_state(command);
    command.add_option("--size", size, "Width x height in pixels")->capture_default_str();
    command.add_option("--press", presses,
                       "A key that a person presses so many seconds after: KEY@SECONDS; may repeat");
    command
        .add_option(
            "--realism", realism,
            "From a sketch (0) over a white model (0.25), plain colours (0.5) and materials (0.75) to "
            "everything (1)")
        ->check(CLI::Range(0.0, 1.0));
    command.add_option("--reflection", method, "Method of reflection in place of the scene's own");
  }

  /// Width and height out of "1280x720".
  Status read_size(int& width, int& height) const { return parse_size(size, width, height); }

  /// The scene with its traffic, at the time given.
  Result<stage::Simulation> open_simulation() const {
    std::filesystem::path script = scene;
    std::vector<std::filesystem::path> folders = data;
    if (Status status = describe_bare_file(script, folders); !status) return status.errors();
    Result<stage::Simulation> simulation = stage::open_simulation(rooms::all_registries(), script, folders);
    if (!simulation) return simulation.errors();
    scene::LiveScene& live = simulation->live();
    if (!method.empty())
      if (const Status status = live.hold(live.unique_node("reflection"), "method", method); !status)
        return error("--reflection: {}", status.errors().front().message);
    if (realism)
      if (const Status status = live.hold(live.unique_node("realism"), "level", fmt::format("{}", *realism));
          !status)
        return error("--realism: {}", status.errors().front().message);
    if (!scenarios.empty())
      if (Status status = live.choose(simulation->scene, scenarios.front()); !status) return status.errors();
    if (Status status = plan_presses(simulation->actions()); !status) return status.errors();
    simulation->advance(time_s);
    simulation->settle();
    return simulation;
  }

  /// Plans what --press asks for.
  Status plan_presses(action::Actions& actions) const {
    for (const std::string& press : presses) {
      const std::size_t at = press.find('@');
      const std::string key = press.substr(0, at);
      const std::vector<double> in_s =
          at == std::string::npos ? std::vector{0.0} : scene::parse_numbers(press.substr(at + 1));
      if (in_s.size() != 1 || in_s[0] < 0.0 || in_s[0] > 86400.0)
        return error("--press {}: expected KEY@SECONDS, as button2@1.5, up to 86400", press);
      if (!actions.uses_key(key))
        return error("--press {}: nothing in the scene waits for the key \"{}\"", press, key);
      actions.press(key, in_s[0]);
    }
    return Ok{};
  }

  /// --scenario for a command that shows one.
  Status expect_one_scenario() const {
    if (scenarios.size() > 1)
      return error("--scenario: one at a time; parvis render writes a picture of each");
    return Ok{};
  }

  /// The same on its stage; needs a current context.
  Result<std::unique_ptr<stage::Stage>> open_stage() const {
    Result<stage::Simulation> simulation = open_simulation();
    if (!simulation) return simulation.errors();
    return stage::Stage::create(*std::move(simulation));
  }
};

}  // namespace parvis
