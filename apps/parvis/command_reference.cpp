// parvis reference: the ray-traced truth of a picture, and the mask of what mirrors in it.
#include "base/image_io.h"
#include "commands.h"
#include "scene_arguments.h"
#include "shading/tone_curve.h"

namespace parvis {
namespace {

struct Arguments : SceneArguments {
  std::filesystem::path output = "reference.png", mask;
  int samples = 16;
};

Status trace(const Arguments& arguments) {
  int width = 0, height = 0;
  if (Status status = arguments.read_size(width, height); !status) return status;
  if (Status status = arguments.expect_one_scenario(); !status) return status;
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  Result<std::unique_ptr<stage::Stage>> stage = arguments.open_stage();
  if (!stage) return stage.errors();
  const Result<Camera> camera = (*stage)->camera(arguments.camera);
  if (!camera) return camera.errors();
  const reference::TracedPicture traced = (*stage)->trace(*camera, width, height, arguments.samples);
  fmt::print("{:.1f} million rays in {:.1f} s: {:.2f} million a second\n", double(traced.rays) * 1e-6,
             traced.seconds, double(traced.rays) * 1e-6 / traced.seconds);
  if (!arguments.mask.empty())
    if (Status status = write_image(arguments.mask, traced.mirror_mask); !status) return status;
  if (arguments.output.extension() == ".exr" || arguments.output.extension() == ".hdr")
    return write_image(arguments.output, traced.radiance);
  return write_image(arguments.output,
                     shading::tone_mapped_picture(traced.radiance, (*stage)->scene().exposure));
}

}  // namespace

void add_reference(CLI::App& app, Chosen& chosen) {
  CLI::App* command = app.add_subcommand("reference", "The same picture by the ray tracer: the truth");
  const auto arguments = std::make_shared<Arguments>();
  arguments->add_scene(*command);
  arguments->add_picture(*command);
  command
      ->add_option("-o,--output", arguments->output,
                   "The picture (.png, .jpg; .exr, .hdr in linear radiance)")
      ->capture_default_str();
  command->add_option("--mask", arguments->mask, "Also write which pixels mirror, for parvis compare --mask");
  command->add_option("--samples", arguments->samples, "Rays a pixel")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  command->footer(
      "Example: parvis reference out/paper/paper.xp --camera street -o truth.png --mask mirrors.png");
  command->callback([arguments, &chosen] { chosen = [arguments] { return trace(*arguments); }; });
}

}  // namespace parvis
