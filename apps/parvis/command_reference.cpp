// parvis reference: the ray-traced truth of a picture, and the mask of what mirrors in it; with
// --path-traced, photographs as a real camera would take them.
#include <cmath>

#include "base/image_io.h"
#include "commands.h"
#include "display_arguments.h"
#include "graphics/shading/tone_curve.h"
#include "interruption.h"
#include "machines/processes.h"
#include "scene_arguments.h"
#include "stage/output_names.h"
#include "stage/photographs.h"

namespace parvis {
namespace {

constexpr int truth_samples = 16, photograph_samples = 64;

struct ReferenceArguments : SceneArguments {
  std::vector<std::filesystem::path> outputs{"reference.png"};
  std::filesystem::path mask;
  std::optional<int> samples;
  std::vector<std::string> cameras;
  bool is_path_traced = false, all_cameras = false;
  std::vector<float> circle;  // target x y z, radius, eye above it, count
  float circle_fov_deg = 50.0f;
  stage::PhotographJob job;
  DisplayArguments walls;

  void add_photograph(CLI::App& command);
};

Status write_traced(const ReferenceArguments& arguments, const reference::TracedPicture& traced,
                    float exposure) {
  fmt::print("{:.1f} million rays in {:.1f} s: {:.2f} million per second\n", double(traced.rays) * 1e-6,
             traced.seconds, double(traced.rays) * 1e-6 / traced.seconds);
  if (!arguments.mask.empty())
    if (Status status = write_image(arguments.mask, traced.mirror_mask); !status) return status;
  for (const std::filesystem::path& output : arguments.outputs) {
    const bool is_linear = output.extension() == ".exr" || output.extension() == ".hdr";
    Status status = is_linear ? write_image(output, traced.radiance)
                              : write_image(output, shading::tone_mapped_picture(traced.radiance, exposure));
    if (!status) return status;
  }
  return Ok{};
}

Status trace(const ReferenceArguments& arguments) {
  int width = 0, height = 0;
  std::vector<std::filesystem::path> files = arguments.outputs;
  if (!arguments.mask.empty()) files.push_back(arguments.mask);
  if (Status status = stage::check_different(files); !status) return status;
  if (Status status = arguments.read_size(width, height); !status) return status;
  if (Status status = arguments.expect_one_scenario(); !status) return status;
  if (arguments.cameras.size() > 1) return error("several cameras are for --path-traced only");
  const Result<machines::Processes> processes = machines::Processes::join();
  if (!processes) return processes.errors();
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  Result<std::unique_ptr<stage::Stage>> stage = arguments.open_stage();
  if (!stage) return stage.errors();
  const Result<Camera> camera = (*stage)->camera(arguments.cameras.empty() ? "" : arguments.cameras.front());
  if (!camera) return camera.errors();
  const reference::TracedPicture traced =
      (*stage)->trace(*camera, width, height, arguments.samples.value_or(truth_samples), *processes);
  if (processes->is_first())
    if (Status status = write_traced(arguments, traced, (*stage)->scene().exposure); !status) return status;
  processes->leave();
  return Ok{};
}

/// Each wall of a display, and each eye.
Status trace_walls(const ReferenceArguments& arguments) {
  const Result<display::Display> display = arguments.walls.read();
  if (!display) return display.errors();
  if (Status status = arguments.expect_one_scenario(); !status) return status;
  if (arguments.cameras.size() > 1 || arguments.outputs.size() > 1)
    return error("--display: one --camera and one folder for --output");
  const Result<machines::Processes> processes = machines::Processes::join();
  if (!processes) return processes.errors();
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  const Result<std::unique_ptr<stage::Stage>> stage = arguments.open_stage();
  if (!stage) return stage.errors();
  const Result<Camera> camera = (*stage)->camera(arguments.cameras.empty() ? "" : arguments.cameras.front());
  if (!camera) return camera.errors();
  const std::vector<display::WallPicture> pictures =
      display::pictures_of(*display, arguments.walls.head(*display), *camera);
  Result<display::Screens> screens = display::Screens::create(*display, pictures);
  if (!screens) return screens.errors();
  stage::trace_walls(**stage, *display, pictures, arguments.samples.value_or(truth_samples), *processes,
                     *screens);
  if (processes->is_first())
    if (Status status = stage::write_walls(*display, pictures, *screens, arguments.outputs.front()); !status)
      return status;
  processes->leave();
  return Ok{};
}

/// The cameras that the user named, or all, or a circle; else the scene's first.
Result<std::vector<scene::NamedCamera>> chosen_cameras(const ReferenceArguments& arguments,
                                                       const stage::Simulation& simulation, float aspect) {
  std::vector<std::string> names = arguments.cameras;
  if (arguments.all_cameras)
    for (const scene::NamedCamera& camera : simulation.scene.cameras) names.push_back(camera.name);
  std::vector<scene::NamedCamera> cameras;
  if (!arguments.circle.empty()) {
    const std::vector<float>& c = arguments.circle;
    const float count = c[5];
    if (count != std::floor(count) || !(count >= 1.0f && count <= 1e6f))
      return error("--circle: a count of {}; expected a whole number of cameras, 1 at least", count);
    Result<std::vector<scene::NamedCamera>> circle =
        stage::circle_of_cameras({c[0], c[1], c[2]}, c[3], c[4], int(count),
                                 vertical_fov(glm::radians(arguments.circle_fov_deg), aspect));
    if (!circle) return circle.errors();
    cameras = *std::move(circle);
  } else if (names.empty()) {
    names.emplace_back();
  }
  for (const std::string& name : names) {
    const Result<Camera> camera = simulation.camera(name);
    if (!camera) return camera.errors();
    cameras.push_back({name, *camera, "", glm::vec3(0.0f)});
  }
  return cameras;
}

Status photograph(const ReferenceArguments& arguments) {
  stage::PhotographJob job = arguments.job;
  if (Status status = arguments.read_size(job.width, job.height); !status) return status;
  if (Status status = arguments.expect_one_scenario(); !status) return status;
  const Result<machines::Processes> processes = machines::Processes::join();
  if (!processes) return processes.errors();
  const Result<stage::Simulation> simulation = arguments.open_simulation();
  if (!simulation) return simulation.errors();
  Result<std::vector<scene::NamedCamera>> cameras =
      chosen_cameras(arguments, *simulation, float(job.width) / float(job.height));
  if (!cameras) return cameras.errors();
  job.cameras = *std::move(cameras);
  job.pictures = arguments.outputs;
  job.options.samples_per_pixel = arguments.samples.value_or(photograph_samples);
  job.options.is_interrupted = &interruption();
  job.options.processes = *processes;
  if (Status status = stage::take_photographs(simulation->scene, job); !status) return status;
  processes->leave();
  return Ok{};
}

void ReferenceArguments::add_photograph(CLI::App& command) {
  CLI::Option* on =
      command.add_flag("--path-traced", is_path_traced,
                       "A photograph: sun, sky and light between surfaces, without approximation");
  const auto photograph_option = [&](const char* name, auto& value, const char* help) {
    return command.add_option(name, value, help)->needs(on)->group("Photographs");
  };
  command.add_flag("--all-cameras", all_cameras, "A picture from every camera of the scene")
      ->needs(on)
      ->group("Photographs");
  photograph_option("--circle", circle,
                    "Cameras on a circle about a point: x,y,z,radius,eye above it (metres),count")
      ->delimiter(',')
      ->expected(6);
  photograph_option("--fov", circle_fov_deg, "Horizontal field of view of the circle's cameras, in degrees")
      ->check(CLI::Range(1.0f, 150.0f))
      ->capture_default_str();
  photograph_option("--bounces", job.options.paths.bounces,
                    "Most surfaces that scatter light on its way (default: no limit)")
      ->check(CLI::Range(0, 1000));
  photograph_option(
      "--clamp", job.options.paths.clamp,
      "Most radiance from beyond the first surface, a sample: no white specks, a little light lost")
      ->check(CLI::PositiveNumber);
  photograph_option("--seed", job.options.seed, "Another seed, another noise")->capture_default_str();
  command
      .add_flag("--restart", job.options.replaces_checkpoint,
                "Start over, even where tiles of another photograph lie beside the output")
      ->needs(on)
      ->group("Photographs");
  photograph_option("--depth", job.depth,
                    "Also write depth: metres along the camera's axis, 0 for the sky (.exr)");
  photograph_option("--alpha", job.alpha, "Also write which share of each pixel is not the sky");
  photograph_option("--colmap", job.colmap_folder,
                    "Also write the cameras as a COLMAP text model, to this folder");
  photograph_option("--cameras-gltf", job.gltf_cameras, "Also write the cameras as glTF (.gltf)");
}

}  // namespace

void add_reference(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("reference", "The same picture by the ray tracer: the truth");
  const auto arguments = std::make_shared<ReferenceArguments>();
  arguments->add_scene(*command);
  arguments->add_picture(*command);
  command->add_option("--camera", arguments->cameras,
                      "Name of the camera (default: the scene's first); repeated for several photographs");
  command
      ->add_option("-o,--output", arguments->outputs,
                   "The picture (.png, .jpg; .exr, .hdr in linear radiance); may be repeated; of --display a "
                   "folder")
      ->capture_default_str();
  command->add_option("--mask", arguments->mask, "Also write which pixels mirror, for parvis compare --mask");
  command->add_option("--samples", arguments->samples, "Rays per pixel (default: 16; photographs: 64)")
      ->check(CLI::Range(1, 65536));
  arguments->add_photograph(*command);
  arguments->walls.add(*command);
  for (const char* of_one_picture : {"--size", "--mask", "--path-traced"})
    command->get_option("--display")->excludes(of_one_picture);
  command->footer(
      "Example: parvis reference out/paper/paper.xp --camera street -o truth.png --mask mirrors.png\n"
      "Example: parvis reference out/paper/paper.xp --path-traced --all-cameras --size 1280x960 -o photo.png "
      "--depth depth.exr --colmap model\n"
      "An interrupted photograph goes on when the same command is given again.\n"
      "Started by mpirun, several processes or machines divide the picture: the same result, sooner.");
  command->callback([arguments, &chosen] {
    chosen = [arguments] {
      return arguments->walls.is_given() ? trace_walls(*arguments)
             : arguments->is_path_traced ? photograph(*arguments)
                                         : trace(*arguments);
    };
  });
}

}  // namespace parvis
