#include "bench/window_bench.h"

#include "base/files.h"
#include "bench/benches.h"
#include "bench/judged_method.h"
#include "bench/own_program.h"
#include "bench/scratch_folder.h"
#include "graphics/gl/context.h"
#include "graphics/gl/objects.h"
#include "graphics/reference/metrics.h"
#include "graphics/render/picture_target.h"
#include "house/stage/stage.h"
#include "places/paper_city/paper_city.h"
#include "reflections/methods/settings.h"
#include "scene/script/scene_loader.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 720;
constexpr double wanted_rate = 10.0;

/// A walk along the pavement of the wide road, past the trees, at a walker's speed.
constexpr const char* walk = R"(
include(file="paper.xp")
camera(name="walk 1", position="-69.0 60.0 1.65", target="-75.0 100.0 1.6", fov_deg=65)
camera(name="walk 2", position="-68.6 84.0 1.65", target="-75.0 124.0 1.6", fov_deg=65)
camera(name="walk 3", position="-68.4 108.0 1.65", target="-76.0 130.0 1.6", fov_deg=65)
tour(name="walk", loop=1) {
  stop(time_s=0, camera="walk 1") stop(time_s=17, camera="walk 2") stop(time_s=34, camera="walk 3")
}
)";

struct Walk {
  double rate;   ///< frames per second
  double share;  ///< of its pixels that the last frame drew
};

Result<Walk> walked(const std::filesystem::path& script, const char* rate, int frames) {
  const Result<OwnRun> run =
      run_own_program(fmt::format("xvfb-run -a -s '-screen 0 {}x{}x24'", width, height),
                      {"view", script.string(), "--size", fmt::format("{}x{}", width, height), "--tour",
                       "walk", "--fps", rate, "--frames", std::to_string(frames)});
  if (!run) return run.errors();
  const Result<double> found = number_after(run->output, "once settled "),
                       percent = number_after(run->output, "the last one drew ");
  if (!found) return found.errors();
  if (!percent) return percent.errors();
  return Walk{*found, 0.01 * *percent};
}

/// The last frame as a window shows it.
Image8 shown(const house::Stage& stage) {
  const gl::Texture texture = gl::texture_2d(GL_RGBA8, width, height);
  const gl::Framebuffer framebuffer = gl::Framebuffer::create();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
  stage.display(framebuffer.name());
  Image8 picture(width, height, 4);
  glGetTextureImage(texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(picture.pixels.size()),
                    picture.pixels.data());
  render::flip_rows(picture);
  return picture;
}

/// FLIP of a frame that draws such a share of its pixels against one that draws all.
Result<double> flip_of_lowered(house::Stage& stage, double share) {
  constexpr int settling_frames = 40;
  const Result<Camera> camera = stage.camera("walk 1");
  if (!camera) return camera.errors();
  stage.draw(*camera, width, height);
  const Image8 whole = shown(stage);
  stage.hold_rate(wanted_rate);
  for (int frame = 0; frame < settling_frames; ++frame) {  // a clock by which this share takes the budget
    stage.draw(*camera, width / 8, height / 8);
    stage.follow_clock(930.0 / wanted_rate * stage.drawn_share() / share);
  }
  stage.draw(*camera, width, height);
  return reference::compare(shown(stage), whole)->flip;
}

Status measure(const BenchSetup& setup, Report& report) {
  if (!gl::is_software() || !has_program("xvfb-run")) {
    report.skip("view_fps_software", "needs a software renderer and the program xvfb-run");
    return Done{};
  }
  const ScratchFolder folder(setup.kept);
  const std::filesystem::path script = folder.path / "walk.xp";
  if (Status written = city::write_paper_city(folder.path, 1); !written) return written.errors();
  if (Status status = write_file(script, walk); !status) return status;
  const Result<scene::LoadedScene> city = scene::load_scene(script, setup.house.get<scene::NodeRegistry>());
  if (!city) return city.errors();
  if (Status kept = keep_maps(setup.house, city->scene, methods::settings(city->scene)); !kept) return kept;
  const int frames = setup.is_quick ? 120 : 400;
  const Result<Walk> held = walked(script, "auto", frames), free = walked(script, "off", 30 + frames / 6);
  if (!held) return held.errors();
  if (!free) return free.errors();
  report.add("view_fps_software", held->rate, {wanted_rate, true});
  report.add_control("view_fps_software_of_fps_off", free->rate, {wanted_rate, true});
  Result<std::unique_ptr<house::Stage>> stage =
      house::Stage::create(house::make_play(setup.house, city->scene));
  if (!stage) return stage.errors();
  const Result<double> flip = flip_of_lowered(**stage, held->share);
  if (!flip) return flip.errors();
  report.add("view_drawn_percent", 100.0 * held->share);
  report.add("view_lowered_flip", *flip);
  return Done{};
}

}  // namespace

void add_window(Benches& benches) {
  benches.add({"window", "frames per second of the window on a virtual display, and its lowered picture",
               in_context(measure)});
}

}  // namespace parvis::bench
