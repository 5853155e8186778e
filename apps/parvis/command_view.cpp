// parvis view: the window.
#include "commands.h"
#include "scene_arguments.h"
#include "viewer/window.h"
#include "window_surroundings.h"

namespace parvis {
namespace {

struct ViewArguments : SceneArguments {
  viewer::WindowOptions window;
  std::string rate;      ///< of --fps; empty: not given
  std::string language;  ///< of --language; empty: the locale's
  std::string sound;     ///< of --sound; empty: not given
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

Status view(ViewArguments& arguments) {
  viewer::WindowOptions& window = arguments.window;
  if (Status status = arguments.read_size(window.width, window.height); !status) return status;
  if (Status status = arguments.expect_one_scenario(); !status) return status;
  if (Status status = read_rate(arguments.rate, window); !status) return status;
  // Pictures that can be repeated make no noise.
  window.sound = !arguments.sound.empty() ? arguments.sound : window.max_frames > 0 ? "off" : "default";
  window.camera = arguments.camera;
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
  command->add_option("--sound", arguments->sound,
                      "Device that sounds, by OpenAL's name; default; null (none); NAME.wav (what headphones "
                      "would play); osc://HOST:PORT (parvis soundserver); or off (default: default; off with "
                      "--frames)");
  command->add_flag("--panel", arguments->window.has_panel, "Begin with the panel open");
  command->add_option("--output", arguments->window.pictures.folder,
                      "Folder of the pictures that the key P takes (default: the scene's)");
  command->add_option("--screenshot", arguments->window.screenshot,
                      "Write what the window shows last, panel and all, when it closes");
  command->footer("Example: parvis view out/paper/paper.xp --camera street");
  command->callback([arguments, &chosen] { chosen = [arguments] { return view(*arguments); }; });
}

}  // namespace parvis
