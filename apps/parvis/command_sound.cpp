// parvis sound: what somebody hears in a scene, as a sound file.
#include <fmt/format.h>

#include "base/file_set.h"
#include "base/progress.h"
#include "commands.h"
#include "interruption.h"
#include "life/sound/listening.h"
#include "life/sound/wave_file.h"
#include "life/tram/tram_line.h"
#include "scene/data/path.h"
#include "scene/script/attribute.h"
#include "scene_arguments.h"

namespace parvis {
namespace {

struct SoundArguments {
  SceneArguments scene;
  std::filesystem::path output;
  std::string path, output_kind = "headphones";
  double seconds = 10.0, speed_m_s = 1.4, gain_db = 0.0;
};

/// The walk of --camera-path; no points: the scene's camera is heard with.
Result<scene::MeasuredPath> read_walk(const SoundArguments& arguments) {
  if (arguments.path.empty()) return scene::MeasuredPath();
  const Result<scene::AttributeValue> points =
      scene::parse_value(scene::attribute::points("--camera-path", ""), arguments.path, Roots(""), {});
  if (!points) return points.errors();
  const auto& given = std::get<std::vector<glm::vec3>>(*points);
  scene::MeasuredPath walk(scene::without_repeats(given));
  if (walk.points().size() < 2)
    return error("--camera-path {}: expected two points or more, as \"0 0 1.7, 40 0 1.7\"", arguments.path);
  return walk;
}

/// A camera that walks along the path and looks ahead.
Camera walker_at(const scene::MeasuredPath& walk, double distance_m) {
  const float at = std::min(float(distance_m), walk.length());
  const glm::vec3 eye = walk.at(at), ahead = walk.direction_at(std::min(at, walk.length() - 1e-3f));
  Camera camera;
  camera.world_from_camera = glm::inverse(glm::lookAt(eye, eye + ahead, glm::vec3(0, 0, 1)));
  return camera;
}

Status run_sound(const SoundArguments& arguments) {
  if (Status status = arguments.scene.expect_one_scenario(); !status) return status;
  if (arguments.output.extension() != ".wav")
    return error("{}: expected a name that ends in .wav", arguments.output.string());
  const Result<scene::MeasuredPath> walk = read_walk(arguments);
  if (!walk) return walk.errors();
  Result<stage::Simulation> simulation = arguments.scene.open_simulation();
  if (!simulation) return simulation.errors();
  const auto output = sound::Output(std::ranges::find(sound::output_names, arguments.output_kind) -
                                    sound::output_names.begin());
  sound::Listening listening(simulation->scene, output);

  constexpr std::size_t moment = sound::sample_rate / 60;  // the clock's step
  const auto moments = std::size_t(std::ceil(arguments.seconds * 60.0));
  std::vector<std::vector<float>> channels(sound::channels_of(output).size(),
                                           std::vector<float>(moments * moment, 0.0f));
  Progress progress("sound", moments);
  std::size_t sounds = 0;
  for (std::size_t i = 0; i < moments; ++i, progress.advance()) {
    if (interruption()) return error("{}: interrupted; nothing is written", arguments.output.string());
    simulation->advance(1.0 / 60.0);
    const double now_s = double(i + 1) / 60.0;
    Camera ears;
    if (walk->points().empty()) {
      const Result<Camera> camera = simulation->camera(arguments.scene.camera);
      if (!camera) return camera.errors();
      ears = *camera;
    } else {
      ears = walker_at(*walk, arguments.speed_m_s * now_s);
    }
    std::vector<std::span<float>> now;
    for (std::vector<float>& channel : channels)
      now.push_back(std::span(channel).subspan(i * moment, moment));
    listening.hear(simulation->scene, ears, simulation->clock.time_s(), now);
    sounds = std::max(sounds, listening.sources());
  }
  const float gain = float(std::pow(10.0, arguments.gain_db / 20.0));
  double energy = 0.0;
  float loudest = 0.0f;
  for (std::vector<float>& channel : channels)
    for (float& sample : channel)
      sample *= gain, energy += double(sample) * double(sample),
          loudest = std::max(loudest, std::abs(sample));
  if (channels.size() == 2) energy *= 0.5;  // of one ear; loudspeakers add up
  std::size_t clipped = 0;
  const std::string bytes = sound::encode_wave(channels, output, &clipped);
  if (Status status = write_together({{arguments.output, bytes}}); !status) return status;
  if (sounds == 0)
    fmt::print(stderr, "warning: nothing sounds in the scene: add sound(...), traffic(...) or tram(...)\n");
  if (clipped > 0)
    fmt::print(stderr,
               "warning: {} samples are louder than the file can hold and are clipped; give --gain -{:.0f}\n",
               clipped, std::ceil(20.0 * std::log10(double(loudest))));
  fmt::print(
      "{}: {:g} s, at most {} sounds; mean level {:.1f} dB{}, where 0 dBFS stands for {:.0f} dB\n",
      arguments.output.string(), arguments.seconds, sounds,
      propagation::level(energy / double(channels[0].size())) + sound::full_scale_db - arguments.gain_db,
      simulation->scene.items<tram::TramLine>().empty() ? "" : " (indicative: no standard has plain trams)",
      sound::full_scale_db - arguments.gain_db);
  return Ok{};
}

}  // namespace

void add_sound(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("sound", "What somebody hears in a scene, as a sound file");
  const auto arguments = std::make_shared<SoundArguments>();
  arguments->scene.add_scene(*command);
  arguments->scene.add_state(*command);
  arguments->scene.add_camera(*command);
  command->add_option("-o,--output", arguments->output, "The file to write (.wav)")->required();
  command->add_option("--camera-path", arguments->path,
                      "In place of the camera: a walk, as \"x y z, x y z\" in metres, looking ahead");
  command->add_option("--speed", arguments->speed_m_s, "Of the walk, in m/s")
      ->check(CLI::Range(0.0, 50.0))
      ->capture_default_str();
  command->add_option("--seconds", arguments->seconds, "How long")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  command
      ->add_option("--for", arguments->output_kind,
                   "headphones (a head's delays and shadow), stereo, 4.0, 5.1 or 7.1 (loudspeakers), or "
                   "microphone (no "
                   "directions)")
      ->check(CLI::IsMember(std::vector<std::string>(sound::output_names.begin(), sound::output_names.end())))
      ->capture_default_str();
  command->add_option("--gain", arguments->gain_db, "In dB: 0 has 0 dBFS stand for 100 dB")
      ->check(CLI::Range(-60.0, 60.0))
      ->capture_default_str();
  command->footer(
      "Example: parvis sound scenes/tram.xp --camera stop --time 10 --seconds 20 -o tram.wav\n"
      "Example: parvis sound place.xp --camera-path \"0 -8 1.7, 40 -8 1.7\" --seconds 25 -o walk.wav");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run_sound(*arguments); }; });
}

}  // namespace parvis
