// Whole commands, run as a user runs them: how much sooner two processes of one thread each take a photograph
// and bake than one, and the rate of the window on a virtual display.
#include <tbb/task_arena.h>

#include <algorithm>

#include "base/files.h"
#include "bench/own_program.h"
#include "bench/parts.h"
#include "bench/reflections/judged_method.h"
#include "graphics/gl/context.h"
#include "graphics/gl/objects.h"
#include "graphics/render/picture_target.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

// One core for each process is one thread for each; so it is for OpenGL in software.
constexpr const char* alone = "env LP_NUM_THREADS=1 taskset -c 0";
constexpr const char* two_cores =
    "env LP_NUM_THREADS=1 mpirun --allow-run-as-root --bind-to core --map-by core -n 2";
constexpr const char* one_core =  // the control
    "env LP_NUM_THREADS=1 taskset -c 0 mpirun --allow-run-as-root --oversubscribe --bind-to none -n 2";

/// How long a command takes, and of that what is divided between processes.
struct Seconds {
  double of_work, of_command;
};

/// The work: the tiles of a photograph, without what each process does before them.
Seconds photograph_s(const std::string& before, const BenchSetup& setup) {
  const OwnRun run =
      run_own_program(before, {"reference", (setup.city() / "paper.xp").string(), "--path-traced", "--camera",
                               "street", "--size", setup.is_quick ? "320x180" : "640x360", "--samples", "16",
                               "-o", (setup.folder / "photo.png").string()});
  return {number_after(run.output, "million rays in "), run.seconds};
}

/// The work: a bake, without a bake that finds all of it done.
Seconds bake_s(const std::string& before, const BenchSetup& setup) {
  fs::remove_all(setup.city() / "some.baked");
  const std::vector<std::string> arguments{"bake", (setup.city() / "some.xp").string()};
  const OwnRun whole = run_own_program(before, arguments), again = run_own_program(before, arguments);
  return {whole.seconds - again.seconds, whole.seconds};
}

/// The city with reference maps on a line along a road.
std::string script_with_maps(int count) {
  std::string script = "include(file=\"paper.xp\")\nreferenceMaps(";
  for (int i = 0; i < count; ++i)
    script += fmt::format("{}position=\"-74 {} 1.2\"", i == 0 ? "" : ", ", -400 + 800 * i / count);
  return script + ")\n";
}

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
  double rate;      ///< frames per second
  double fraction;  ///< of its pixels that the last frame drew
};

Walk walked(const fs::path& script, const char* rate, int frames) {
  const std::string size = fmt::format("{}x{}", full_picture.x, full_picture.y);
  const OwnRun run = run_own_program(fmt::format("xvfb-run -a -s '-screen 0 {}x24'", size),
                                     {"view", script.string(), "--size", size, "--tour", "walk", "--fps",
                                      rate, "--frames", std::to_string(frames)});
  return {number_after(run.output, "once settled "), 0.01 * number_after(run.output, "the last one drew ")};
}

/// The last frame as a window shows it.
Image8 shown(const stage::Stage& stage) {
  const gl::Texture texture = gl::texture_2d(GL_RGBA8, full_picture.x, full_picture.y);
  const gl::Framebuffer framebuffer = gl::Framebuffer::create();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
  stage.display(framebuffer.name());
  Image8 picture(full_picture.x, full_picture.y, 4);
  glGetTextureImage(texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, GLsizei(picture.pixels.size()),
                    picture.pixels.data());
  render::flip_rows(picture);
  return picture;
}

/// FLIP of a frame that draws such a fraction of its pixels against one that draws all.
double flip_of_lowered(stage::Stage& stage, double fraction) {
  constexpr int settling_frames = 40;
  constexpr double rate = 15.0;
  const Camera camera = must(stage.camera("walk 1"));
  const auto draw = [&](int smaller) {
    stage.draw(camera, full_picture.x / smaller, full_picture.y / smaller);
  };
  draw(1);
  const Image8 whole = shown(stage);
  stage.hold_rate(rate);
  for (int frame = 0; frame < settling_frames; ++frame) {  // a clock by which this fraction takes the budget
    draw(8);
    stage.follow_clock(930.0 / rate * stage.drawn_share() / fraction);
  }
  draw(1);
  return flip_between(shown(stage), whole);
}

}  // namespace

void measure_processes(const BenchSetup& setup, Report& report) {
  if (tbb::this_task_arena::max_concurrency() < 2 || !has_program("mpirun") || !has_program("taskset"))
    return report.skip("speedup_2_processes", "needs two cores and the programs mpirun and taskset");
  must(write_file(setup.city() / "some.xp", script_with_maps(setup.is_quick ? 40 : 160)));
  double whole = 1e9, work = 1e9, whole_on_one_core = 0.0,
         work_on_one_core = 0.0;  // of the slower; of the faster
  for (const auto& [name, seconds_of] : {std::pair{"photograph", &photograph_s}, {"bake", &bake_s}}) {
    const Seconds one = seconds_of(alone, setup), two = seconds_of(two_cores, setup),
                  shared = seconds_of(one_core, setup);
    report.add(fmt::format("speedup_2_processes_{}", name), one.of_command / two.of_command);
    report.add(fmt::format("speedup_2_processes_of_the_work_{}", name), one.of_work / two.of_work);
    report.note(fmt::format(
        "{}: {:.1f} s alone, {:.1f} s by two, {:.1f} s by two on one core; of that the work: "
        "{:.1f}, {:.1f}, {:.1f} s",
        name, one.of_command, two.of_command, shared.of_command, one.of_work, two.of_work, shared.of_work));
    whole = std::min(whole, one.of_command / two.of_command),
    work = std::min(work, one.of_work / two.of_work);
    whole_on_one_core = std::max(whole_on_one_core, one.of_command / shared.of_command);
    work_on_one_core = std::max(work_on_one_core, one.of_work / shared.of_work);
  }
  report.add("speedup_2_processes", whole);
  report.add("speedup_2_processes_on_one_core", whole_on_one_core);
  report.add("speedup_2_processes_of_the_work", work);
  report.add("speedup_2_processes_of_the_work_on_one_core", work_on_one_core);
}

void measure_window(const BenchSetup& setup, Report& report) {
  if (!gl::is_software() || !has_program("xvfb-run"))
    return report.skip("view_fps_software", "needs a software renderer and the program xvfb-run");
  const fs::path script = setup.city() / "walk.xp";
  must(write_file(script, walk));
  const scene::Scene city = setup.scene(script);
  keep_maps(city, methods::settings(city));
  const int frames = setup.is_quick ? 120 : 400;
  const Walk held = walked(script, "auto", frames), free = walked(script, "off", 30 + frames / 6);
  report.add("view_fps_software", held.rate);
  report.add("view_fps_software_of_fps_off", free.rate);
  report.add("view_drawn_percent", 100.0 * held.fraction);
  report.add("view_lowered_flip", flip_of_lowered(*stage_of(city), held.fraction));
}

}  // namespace parvis::bench
