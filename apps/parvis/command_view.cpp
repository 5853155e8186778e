// parvis view: the window.
#include "base/files.h"
#include "commands.h"
#include "display_arguments.h"
#include "machines/processes.h"
#include "scene_arguments.h"
#include "viewer/walls.h"
#include "viewer/window.h"
#include "window_surroundings.h"

namespace parvis {
namespace {

struct ViewArguments : SceneArguments {
  viewer::WindowOptions window;
  std::string rate;      ///< of --fps; empty: not given
  std::string language;  ///< of --language; empty: the locale's
  std::string sound;     ///< of --sound; empty: not given
  int text_percent = 100;
  DisplayArguments display;
  std::filesystem::path devices;  ///< of --devices; empty: not given
  viewer::WallsOptions on_walls;  ///< what --display alone has
};

/// --fps.
Status read_rate(const std::string& rate, viewer::WindowOptions& window) {
  constexpr double max_rate = 1000.0;
  if (rate.empty()) return Ok{};
  if (rate == "off") {
    window.frames_per_second = 0.0;
    return Ok{};
  }
  if (rate == "auto") {
    window.always_holds_rate = true;
    return Ok{};
  }
  const std::vector<double> numbers = scene::parse_numbers(rate);
  if (numbers.size() != 1 || !(numbers[0] >= 1.0 && numbers[0] <= max_rate))
    return error("--fps {}: expected frames per second, 1 to {}, auto or off", rate, max_rate);
  window.frames_per_second = numbers[0];
  return Ok{};
}

/// --devices.
Result<devices::DeviceSettings> read_settings(const std::filesystem::path& file) {
  const Result<std::string> text = read_file(file, 1 << 20);
  if (!text) return text.errors();
  return devices::read_devices(*text, file.string());
}

/// Shows it on the walls of a room.
Status view_walls(ViewArguments& arguments) {
  if (Status status = arguments.expect_one_scenario(); !status) return status;
  viewer::WallsOptions& options = arguments.on_walls;
  const Result<display::Display> display = arguments.display.read();
  if (!display) return display.errors();
  options.display = *display;
  options.eye = arguments.display.head(*display).position;
  if (arguments.devices.empty()) {
    if (display->head.empty() && display->wand.empty()) options.devices.osc_port = 0;
  } else {
    const Result<devices::DeviceSettings> settings = read_settings(arguments.devices);
    if (!settings) return settings.errors();
    options.devices = *settings;
  }
  options.title = arguments.scene.stem().string(), options.camera = arguments.camera;
  options.max_frames = arguments.window.max_frames, options.plans = arguments.window.plans;
  options.sound = !arguments.sound.empty() ? arguments.sound : options.max_frames > 0 ? "off" : "default";
  options.kept_pictures = kept_pictures();
  const Result<machines::Processes> processes = machines::Processes::join();
  if (!processes) return processes.errors();
  options.processes = *processes;
  Result<stage::Simulation> simulation = arguments.open_simulation();
  if (!simulation) return simulation.errors();
  if (!arguments.tour.empty())
    if (const Result<double> length = simulation->actions().start_tour(arguments.tour); !length)
      return length.errors();
  if (Status status = viewer::show_walls(*std::move(simulation), options); !status) return status;
  processes->leave();
  return Ok{};
}

Status view(ViewArguments& arguments) {
  if (arguments.display.is_given()) return view_walls(arguments);
  viewer::WindowOptions& window = arguments.window;
  if (Status status = arguments.read_size(window.width, window.height); !status) return status;
  if (Status status = arguments.expect_one_scenario(); !status) return status;
  if (Status status = read_rate(arguments.rate, window); !status) return status;
  if (!arguments.devices.empty()) {
    const Result<devices::DeviceSettings> settings = read_settings(arguments.devices);
    if (!settings) return settings.errors();
    window.devices = *settings;
  }
  // Pictures that can be repeated make no noise.
  window.sound = !arguments.sound.empty() ? arguments.sound : window.max_frames > 0 ? "off" : "default";
  window.camera = arguments.camera;
  window.text_size = float(arguments.text_percent) / 100.0f;
  window.title = arguments.scene.stem().string();
  window.pictures.name = window.title;
  if (window.pictures.folder.empty())
    window.pictures.folder = (arguments.scene.parent_path() / ".").lexically_normal();
  window.language = design::language_of(arguments.language.empty() ? locale() : arguments.language);
  window.kept_pictures = kept_pictures();
  Result<stage::Simulation> simulation = arguments.open_simulation();
  if (!simulation) return simulation.errors();
  if (!arguments.tour.empty())
    if (const Result<double> length = simulation->actions().start_tour(arguments.tour); !length)
      return length.errors();
  return viewer::show(*std::move(simulation), window);
}

}  // namespace

void add_view(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("view", "Opens a window: walk, fly, follow a vehicle");
  const auto arguments = std::make_shared<ViewArguments>();
  arguments->add_scene(*command);
  arguments->add_camera(*command);
  arguments->add_picture(*command);
  command->add_option("--tour", arguments->tour, "Begin with a tour of the scene; moving ends it");
  command->add_option("--frames", arguments->window.max_frames, "Close after so many frames")
      ->check(CLI::Range(0, 1000000));
  command->add_option("--fps", arguments->rate,
                      "Frames per second to hold by drawing fewer pixels while anything moves; auto: 15 on a "
                      "software renderer, 60 on a GPU; or off (default: auto; off with --frames)");
  command->add_flag("--plan", arguments->window.plans,
                    "Begin with the planner's tool in hand: place, move and measure objects of a design");
  command->add_option("--language", arguments->language, "Of the planner's tool (default: the locale's)")
      ->check(CLI::IsMember({"en", "fr"}));
  command
      ->add_option("--text-size", arguments->text_percent,
                   "Of all that is written and pressed in the window, percent, as far as it fits; Ctrl and + "
                   "or - change it (default: 100)")
      ->check(CLI::Range(100, 300));
  command->add_option("--sound", arguments->sound,
                      "Device that sounds, by OpenAL's name; default; null (none); NAME.wav (what headphones "
                      "would play); osc://HOST:PORT (parvis soundserver); or off (default: default; off with "
                      "--frames)");
  command->add_flag("--panel", arguments->window.has_panel, "Begin with the panel open");
  command->add_option("--output", arguments->window.pictures.folder,
                      "Folder of the pictures that the key P takes (default: the scene's)");
  command->add_option("--screenshot", arguments->window.screenshot,
                      "Write what the window shows last, panel and all, when it closes");
  arguments->display.add(*command);
  CLI::Option* const display = command->get_option("--display");
  for (const char* of_a_window : {"--size", "--fps", "--panel", "--text-size", "--screenshot", "--output"})
    display->excludes(of_a_window);
  const auto of_walls = [&](const char* name, std::filesystem::path& file, const char* help) {
    command->add_option(name, file, help)->needs(display)->group("Displays");
  };
  command->add_option(
      "--devices", arguments->devices,
      "Gamepads, 3D mice, trackers and a wand (.json; docs/displays.md); trackers and wand with "
      "--display");
  of_walls("--record", arguments->on_walls.recording, "Write what devices say to this file");
  of_walls("--replay", arguments->on_walls.replayed, "Such a file in place of the devices");
  of_walls("--frame-log", arguments->on_walls.frame_log,
           "Write when each frame was shown, to FILE.PROCESS.csv");
  of_walls("--walls-output", arguments->on_walls.screenshots,
           "Write what the walls show last, to this folder");
  command->footer(
      "Example: parvis view out/paper/paper.xp --camera street\n"
      "Example: mpirun -n 5 parvis view scenes/square.xp --display scenes/displays/cave.json\n"
      "Started by mpirun, each process shows one wall; one process more than walls shows an operator's "
      "view.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return view(*arguments); }; });
}

}  // namespace parvis
