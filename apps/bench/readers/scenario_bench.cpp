#include "bench/readers/scenario_bench.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "base/files.h"
#include "bench/scratch_folder.h"
#include "house/stage/stage.h"
#include "places/paper_city/paper_city.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 720;

/// The street's trees give way to a tramway; others are planted in the park and at the corner.
constexpr const char* project = R"(
include(file="paper.xp")
scenario(name="tramway") {
  override(of="tree 1", visible=0)
  override(of="tree 2", visible=0)
  override(of="tree 3", visible=0)
  override(of="tree 4", visible=0)
  model(name="oak 1", file="park_tree.glb", position="-40 28 0.15", heading_deg=10)
  model(name="oak 2", file="park_tree.glb", position="-38 40 0.15", heading_deg=120)
  model(name="oak 3", file="street_tree.glb", position="-69.3 96 0", heading_deg=200)
  model(name="oak 4", file="street_tree.glb", position="-78.7 160 0", heading_deg=300)
}
)";

}  // namespace

Status measure_scenarios(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  if (Status status = city::write_paper_city(folder.path, 1); !status) return status;
  if (Status status = write_file(folder.path / "project.xp", project); !status) return status;
  Result<house::Play> play = house::open_play(setup.house, folder.path / "project.xp", {});
  if (!play) return play.errors();
  play->advance(8.0);
  Result<std::unique_ptr<house::Stage>> made = house::Stage::create(*std::move(play));
  if (!made) return made.errors();
  house::Stage& stage = **made;
  const Result<Camera> camera = stage.camera("street");
  if (!camera) return camera.errors();
  const auto frame_ms = [&] {
    return milliseconds([&] {
      stage.draw(*camera, width, height);
      glFinish();
    });
  };
  for (int i = 0; i < 3; ++i) frame_ms();  // makes what is made once

  std::vector<double> samples;
  const int switches = setup.is_quick ? 8 : 24;
  for (int i = 0; i < switches; ++i) {
    Status chosen = Done{};
    const double choice_ms =
        milliseconds([&] { chosen = stage.choose_scenario(i % 2 == 0 ? "tramway" : ""); });
    if (!chosen) return chosen;
    const double first_ms = frame_ms(), ordinary_ms = median({frame_ms(), frame_ms(), frame_ms()}).value;
    samples.push_back(choice_ms + first_ms - ordinary_ms);
  }
  report.add("scenario_switch_ms", median(samples));
  report.note(
      fmt::format("four of the paper's trees go and four others come, and back: the first switch {:.0f} "
                  "ms, the slowest {:.0f} ms",
                  samples.front(), *std::max_element(samples.begin(), samples.end())));
  return Done{};
}

}  // namespace parvis::bench
