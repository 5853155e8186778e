// parvis render: a picture or a film of a scene.
#include <algorithm>
#include <cmath>

#include "base/content_hash.h"
#include "base/image_io.h"
#include "base/progress.h"
#include "base/reduction.h"
#include "commands.h"
#include "display_arguments.h"
#include "graphics/render/picture_reader.h"
#include "interruption.h"
#include "life/sound/listening.h"
#include "life/sound/wave_file.h"
#include "machines/processes.h"
#include "reflections/methods/registry.h"
#include "scene/data/scene_key.h"
#include "scene_arguments.h"
#include "stage/divided_film.h"
#include "stage/film.h"
#include "stage/output_names.h"
#include "stage/probe.h"

namespace parvis {
namespace {

struct RenderArguments : SceneArguments {
  std::filesystem::path output = "picture.png";
  double seconds = 0.0;
  int frames_per_second = 24;
  int supersample = 1;
  bool has_sound = false;
  std::vector<std::string> probes;  ///< "X,Y": pixels of the picture
  DisplayArguments walls;
};

Status draw(stage::Stage& stage, const RenderArguments& arguments, int width, int height) {
  stage.simulation().settle();
  const Result<Camera> camera = stage.camera(arguments.camera);
  if (!camera) return camera.errors();
  const int n = arguments.supersample;
  stage.draw(*camera, n * width, n * height);
  return Ok{};
}

/// Frames of a film, and errors of what is none.
Result<int> frames_of(const RenderArguments& arguments, const std::filesystem::path& output) {
  const int frames = int(std::lround(arguments.seconds * arguments.frames_per_second));
  if (frames < 1)
    return error("{}: {} s at {} frames per second are no frame; give it more --seconds", output.string(),
                 arguments.seconds, arguments.frames_per_second);
  return frames;
}

/// Adds the script's nodes, and the changes since.
void add(ContentHash& hash, const scene::Nodes& nodes) {
  for (const scene::Node& node : nodes) {
    hash.add_text(node.schema->type);
    for (const std::vector<scene::NodeAttribute>& attributes : {node.attributes, node.overrides})
      for (const scene::NodeAttribute& attribute : attributes) hash.add_text(scene::written(attribute));
    add(hash, node.children);
  }
}

/// All that the frames of a film depend on.
std::uint64_t film_key(stage::Stage& stage, const RenderArguments& arguments, int width, int height) {
  ContentHash hash;
  const scene::Scene& scene = stage.scene();
  hash.add(scene::scene_key(scene));
  add(hash, stage.simulation().live().nodes());  // tours, paths and timers among them
  scene.room_data.hash(hash, [](scene::DataRole) { return true; });
  for (const scene::NamedCamera& named : scene.cameras) {
    hash.add_text(named.name + "/" + named.follows);
    hash.add(named.camera.world_from_camera);
    hash.add(named.camera.tangents(float(width) / float(height)));
    hash.add(named.offset_m);
  }
  hash.add(scene.exposure);
  for (const int value : {width, height, arguments.frames_per_second, arguments.supersample}) hash.add(value);
  hash.add(arguments.time_s);
  hash.add_text(arguments.camera + "/" + arguments.tour + "/" + arguments.method);
  for (const std::vector<std::string>& words : {arguments.scenarios, arguments.presses})
    for (const std::string& word : words) hash.add_text(word);
  return hash.value();
}

/// Methods whose picture depends on the frames before it: a process that draws some of them would draw
/// others.
Status expect_single_frames(const stage::Stage& stage) {
  const methods::Settings& reflection = methods::settings(stage.scene());
  const Result<const methods::Method*> method =
      stage.registries().get<methods::Registry>().method_of(stage.scene());
  if (!method) return method.errors();
  if ((*method)->needs_earlier_frames || reflection.budget_ms > 0.0f)
    return error(
        "reflection(method={}, budget_ms={}): each frame depends on those before it, so that a film cannot "
        "be divided among processes; render it without mpirun, or take another --reflection",
        (*method)->name, reflection.budget_ms);
  return Ok{};
}

/// The sound at a film's camera.
class FilmSound {
 public:
  FilmSound(stage::Stage& stage, int frames_per_second)
      : stage_(stage),
        listening_(stage.scene(), sound::Output::stereo),
        moment_(std::size_t(sound::sample_rate / frames_per_second)) {}

  /// The sound of one frame.
  Status hear(const std::string& camera) {
    const Result<Camera> ears = stage_.camera(camera);
    if (!ears) return ears.errors();
    for (std::vector<float>& channel : channels_) channel.resize(channel.size() + moment_, 0.0f);
    const std::array now{std::span(channels_[0]).last(moment_), std::span(channels_[1]).last(moment_)};
    listening_.hear(stage_.scene(), *ears, stage_.simulation().clock.time_s(), now);
    return Ok{};
  }
  /// A file of all that was heard, 20 dB louder than `parvis sound` writes: 0 dBFS stands for 80 dB, or for
  /// the loudest moment.
  std::string wave() {
    constexpr float gain = 10.0f;
    float loudest = 0.1f;
    for (const std::vector<float>& channel : channels_)
      for (const float sample : channel) loudest = std::max(loudest, std::abs(sample));
    for (std::vector<float>& channel : channels_)
      for (float& sample : channel) sample *= std::min(gain, 1.0f / loudest);
    return sound::encode_wave(channels_, sound::Output::stereo);
  }

 private:
  stage::Stage& stage_;
  sound::Listening listening_;
  std::size_t moment_;
  std::array<std::vector<float>, 2> channels_;
};

/// A film whose frames several processes divide, or have begun to.
Status render_divided_film(stage::Stage& stage, const RenderArguments& arguments,
                           const std::filesystem::path& output, int width, int height,
                           const machines::Processes& processes) {
  if (Status status = expect_single_frames(stage); !status) return status;
  const Result<int> frames = frames_of(arguments, output);
  if (!frames) return frames.errors();
  int now = 0;  // the frame that the scene has come to
  stage::FilmJob job;
  job.output = output;
  job.width = width, job.height = height;
  job.frames_per_second = arguments.frames_per_second, job.frames = *frames;
  job.key = film_key(stage, arguments, width, height);
  job.is_interrupted = &interruption();
  job.draw = [&](int frame) -> Result<Image8> {
    for (; now < frame; ++now) stage.simulation().advance(1.0 / arguments.frames_per_second);
    if (Status status = draw(stage, arguments, width, height); !status) return status.errors();
    return reduced(stage.picture(), arguments.supersample);
  };
  if (Status status = stage::make_divided_film(job, processes); !status) return status;
  for (; now < *frames; ++now) stage.simulation().advance(1.0 / arguments.frames_per_second);
  return Ok{};
}

Status render_film(stage::Stage& stage, const RenderArguments& arguments, const std::filesystem::path& output,
                   int width, int height, const machines::Processes& processes) {
  const std::atomic<bool>& is_interrupted = interruption();  // half a film is taken away, not left
  const bool is_begun = std::filesystem::exists(stage::frames_folder(output)) && expect_single_frames(stage);
  if (processes.are_several() || is_begun)
    return render_divided_film(stage, arguments, output, width, height, processes);
  Result<stage::Film> film = stage::Film::open(output, width, height, arguments.frames_per_second);
  if (!film) return film.errors();
  const Result<int> frames = frames_of(arguments, output);
  if (!frames) return frames.errors();
  std::optional<FilmSound> sound;
  if (arguments.has_sound) sound.emplace(stage, arguments.frames_per_second);
  render::PictureReader reader;
  Progress progress("rendering film", std::size_t(*frames));
  for (int frame = 0; frame < *frames; ++frame) {
    if (is_interrupted) return error("{}: interrupted; no film is written", output.string());
    if (Status status = draw(stage, arguments, width, height); !status) return status;
    if (const auto picture = reader.next(stage.renderer(), stage.scene().exposure)) {
      if (Status status = film->add(reduced(*picture, arguments.supersample)); !status) return status;
    }
    if (sound)
      if (Status status = sound->hear(arguments.camera); !status) return status;
    stage.simulation().advance(1.0 / arguments.frames_per_second);
    progress.advance();
  }
  while (const auto picture = reader.rest())
    if (Status status = film->add(reduced(*picture, arguments.supersample)); !status) return status;
  return film->finish(sound ? sound->wave() : std::string());
}

/// Pixels of --probe.
Result<std::vector<glm::ivec2>> probed_pixels(const RenderArguments& arguments, int width, int height) {
  std::vector<glm::ivec2> pixels;
  for (const std::string& text : arguments.probes) {
    glm::ivec2 pixel(0);
    char comma = 0, rest = 0;
    if (std::sscanf(text.c_str(), "%d%c%d%c", &pixel.x, &comma, &pixel.y, &rest) != 3 || comma != ',' ||
        pixel.x < 0 || pixel.y < 0 || pixel.x >= width || pixel.y >= height)
      return error("--probe {}: expected a pixel of the picture, which has {} x {}, as 640,400", text, width,
                   height);
    pixels.push_back(pixel);
  }
  return pixels;
}

/// Prints the values of the picture just drawn that --probe asks for.
Status print_probes(const stage::Stage& stage, const RenderArguments& arguments, int width, int height) {
  const Result<std::vector<glm::ivec2>> pixels = probed_pixels(arguments, width, height);
  if (!pixels) return pixels.errors();
  const Result<Camera> camera = stage.camera(arguments.camera);
  if (!camera) return camera.errors();
  for (const glm::ivec2 pixel : *pixels)
    fmt::print("{},{}: {}\n", pixel.x, pixel.y,
               to_string(stage::probe(stage.scene(), *camera, {width, height}, pixel), stage.scene()));
  return Ok{};
}

/// A picture, or a film: of --seconds, or as long as the tour.
Status render_one(stage::Stage& stage, RenderArguments arguments, const std::filesystem::path& output,
                  int width, int height, const machines::Processes& processes) {
  if (!arguments.tour.empty()) {
    const Result<double> length_s = stage.simulation().actions().start_tour(arguments.tour);
    if (!length_s) return length_s.errors();
    if (arguments.seconds == 0.0) arguments.seconds = *length_s;
  }
  if (arguments.seconds > 0.0) return render_film(stage, arguments, output, width, height, processes);
  if (!processes.is_first()) return Ok{};  // one frame is not divided
  if (Status status = draw(stage, arguments, width, height); !status) return status;
  if (Status status = print_probes(stage, arguments, width, height); !status) return status;
  return write_image(output, reduced(stage.picture(), arguments.supersample));
}

/// The scene as it begins, or a picture or film of each scenario.
Status render_states(stage::Stage& stage, const RenderArguments& arguments, int width, int height,
                     const machines::Processes& processes) {
  if (arguments.scenarios.size() < 2)
    return render_one(stage, arguments, arguments.output, width, height, processes);
  const std::vector<std::filesystem::path> outputs =
      stage::series_files(arguments.output, '-', arguments.scenarios);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (Status status = stage.choose_scenario(arguments.scenarios[i]); !status) return status;
    if (Status status = render_one(stage, arguments, outputs[i], width, height, processes); !status)
      return status;
  }
  return Ok{};
}

/// A picture of each wall of a display, and of each eye.
Status render_walls(const RenderArguments& arguments) {
  const Result<display::Display> display = arguments.walls.read();
  if (!display) return display.errors();
  if (arguments.scenarios.size() > 1) return error("--display: one --scenario at a time");
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  const Result<std::unique_ptr<stage::Stage>> stage = arguments.open_stage();
  if (!stage) return stage.errors();
  const Result<Camera> camera = (*stage)->camera(arguments.camera);
  if (!camera) return camera.errors();
  const std::vector<display::WallPicture> pictures =
      display::pictures_of(*display, arguments.walls.head(*display), *camera);
  Result<display::Screens> screens = display::Screens::create(*display, pictures);
  if (!screens) return screens.errors();
  if (Status status = stage::draw_walls(**stage, *display, pictures, *screens); !status) return status;
  return stage::write_walls(*display, pictures, *screens, arguments.output);
}

Status render_scene(const RenderArguments& arguments) {
  if (arguments.walls.is_given()) return render_walls(arguments);
  int width = 0, height = 0;
  if (Status status = arguments.read_size(width, height); !status) return status;
  if (const auto pixels = probed_pixels(arguments, width, height); !pixels) return pixels.errors();
  const Result<machines::Processes> processes = machines::Processes::join();
  if (!processes) return processes.errors();
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  Result<std::unique_ptr<stage::Stage>> stage = arguments.open_stage();
  if (!stage) return stage.errors();
  if (Status status = render_states(**stage, arguments, width, height, *processes); !status) return status;
  processes->leave();
  return Ok{};
}

}  // namespace

void add_render(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("render", "A picture of a scene, or a film of it");
  const auto arguments = std::make_shared<RenderArguments>();
  arguments->add_scene(*command);
  arguments->add_camera(*command);
  arguments->add_picture(*command);
  arguments->walls.add(*command);
  command
      ->add_option("-o,--output", arguments->output,
                   "The picture (.png, .jpg) or film (.mp4); of --display a folder")
      ->capture_default_str();
  command->add_option("--tour", arguments->tour, "A film of a tour of the scene")->excludes("--camera");
  command->add_option("--seconds", arguments->seconds, "Length of a film; 0: a picture, or the whole tour")
      ->check(CLI::Range(0.0, 86400.0));
  command->add_option("--fps", arguments->frames_per_second, "Frames per second of a film")
      ->check(CLI::Range(1, 240))
      ->capture_default_str();
  for (const char* of_one_picture : {"--size", "--tour", "--seconds"})
    command->get_option("--display")->excludes(of_one_picture);
  command->add_flag("--sound", arguments->has_sound, "A film with what its camera hears; not with mpirun");
  command
      ->add_option("--supersample", arguments->supersample,
                   "Draw n x n as many pixels and average their light")
      ->check(CLI::Range(1, 4))
      ->capture_default_str();
  command->add_option("--probe", arguments->probes,
                      "Print what a pixel X,Y of a picture shows: metres, object, kind; may repeat");
  command->footer(
      "Example: parvis render out/paper/paper.xp --camera follow --seconds 10 -o out/drive.mp4\n"
      "Example: parvis render scenes/square.xp --display scenes/displays/cave.json -o out/walls\n"
      "Started by mpirun, several processes or machines divide a film into frames: the same film, sooner. "
      "Interrupted, its finished frames stay in FILM.frames, and the same command goes on.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return render_scene(*arguments); }; });
}

}  // namespace parvis
