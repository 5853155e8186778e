#include "bench/frame/frame_bench.h"

#include <epoxy/gl.h>

#include <filesystem>

#include "base/test_data.h"
#include "bench/benches.h"
#include "bench/frame/mirror_check.h"
#include "bench/judged_method.h"
#include "bench/scratch_folder.h"
#include "bench/street_views.h"
#include "formats/city_models/city_json.h"
#include "graphics/render/test_culling_check.h"
#include "house/stage/stage.h"
#include "places/paper_city/paper_city.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

constexpr int width = 1280, height = 720;

const methods::Settings mem{"multiple_environment_maps", 128, false};

/// Times whole frames of each method in alternating order.
Status time_methods(house::Stage& stage, const Camera& camera, int cars, int repeats, Report& report,
                    std::vector<Median>& medians) {
  const Result<std::vector<JudgedMethod>> judged =
      judged_methods(stage, {{"none", methods::Settings{"none"}},
                             {"rerendered", {"rerendered_cube_map", 128, false}},
                             {"rerendered_lod", {"rerendered_cube_map", 128, true}},
                             {"mem", mem},
                             {"mem_lod", {"multiple_environment_maps", 128, true}}});
  if (!judged) return judged.errors();
  const std::vector<JudgedMethod>& methods = *judged;
  std::vector<std::vector<double>> samples(methods.size());
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (std::size_t i = 0; i < methods.size(); ++i) {
      const std::size_t m = repeat % 2 == 0 ? i : methods.size() - 1 - i;
      if (Status status = draw(stage, methods[m], camera, width, height); !status)
        return status;  // makes what is made once
      glFinish();
      Status drawn = Done{};
      samples[m].push_back(milliseconds([&] {
        drawn = draw_again(stage, methods[m], camera, width, height);
        glFinish();
      }));
      if (!drawn) return drawn;
    }
  for (std::size_t m = 0; m < methods.size(); ++m) {
    medians.push_back(median(samples[m]));
    report.add(fmt::format("frame_ms_{}_{}", methods[m].name, cars), medians.back());
  }
  return Done{};
}

/// Cars that are hidden by what stands before them: how many are culled, and whether one is that has a pixel.
void measure_occlusion(house::Stage& stage, std::size_t views, Report& report) {
  render::CullingCheck all;
  for (const Camera& camera : street_views(stage.scene(), views, 1.6f, 0.0f, width, height)) {
    stage.renderer().begin_frame(stage.scene(), camera);
    const render::CullingCheck one =
        render::check_culling(stage.renderer(), stage.scene(), camera, width, height);
    all.hidden += one.hidden, all.hidden_culled += one.hidden_culled, all.false_culls += one.false_culls;
  }
  report.add("occlusion_culled_percent", all.hidden > 0 ? 100.0 * all.hidden_culled / all.hidden : 0.0);
  report.add("false_culls", all.false_culls);
  report.note(fmt::format("{} of {} hidden cars in the frustum are culled, over {} views", all.hidden_culled,
                          all.hidden, views));
}

void measure_reference(house::Stage& stage, Report& report) {
  const Camera camera = street_views(stage.scene(), 1, 1.6f, 0.0f, width, height).front();
  const reference::TracedPicture traced = stage.trace(camera, 480, 270, 16);
  report.add("reference_mrays_s", 1e-6 * double(traced.rays) / traced.seconds);
}

void measure_denhaag(Report& report) {
  const auto file = shared_data("cities/DenHaag_01.city.json", fs::current_path());
  if (!file) return report.skip("load_ms_denhaag", "the shared data is absent");
  std::vector<double> samples(5);
  for (double& sample : samples)
    sample = milliseconds([&] {
      Errors warnings;
      static_cast<void>(scene::read_city_model(*file, warnings));
    });
  report.add("load_ms_denhaag", median(samples));
}

Status measure(const BenchSetup& setup, Report& report) {
  const ScratchFolder folder;
  Status written = Done{};
  const double generated_ms = milliseconds([&] { written = city::write_paper_city(folder.path, 1); });
  if (!written) return written.errors();
  const Result<scene::LoadedScene> loaded =
      scene::load_scene(folder.path / "paper.xp", setup.house.get<scene::NodeRegistry>());
  if (!loaded) return loaded.errors();
  report.add("triangles", double(loaded->scene.static_triangle_count()));
  report.add("city_generate_ms", generated_ms);

  if (Status kept = keep_maps(setup.house, loaded->scene, mem); !kept) return kept.errors();
  const int repeats = setup.is_quick ? 7 : 21;
  for (const auto& [cars, minimum, maximum] : {std::tuple{15, 3, 5}, std::tuple{30, 10, 10}}) {
    Result<std::unique_ptr<house::Stage>> stage =
        house::Stage::create(play_with(setup.house, loaded->scene, cars));
    if (!stage) return stage.errors();
    const Result<Camera> camera = view_of_cars(**stage, minimum, maximum, width, height, report);
    if (!camera) return camera.errors();
    const int seen = reflectors_seen(**stage, *camera, width, height);
    std::vector<Median> medians;
    if (Status status = time_methods(**stage, *camera, cars, repeats, report, medians); !status)
      return status.errors();
    if (cars < 30) continue;
    report.add("rerendered_ms_per_car", (medians[1].value - medians[0].value) / std::max(seen, 1));
    measure_occlusion(**stage, setup.is_quick ? 80 : 400, report);
    measure_reference(**stage, report);
  }
  measure_denhaag(report);
  const Result<MirrorFlips> flips = mirror_flips(setup.house);
  if (!flips) return flips.errors();
  report.add("ball_flip", flips->ball);
  report.add("box_flip", flips->box);
  report.add("ball_flip_faces_swapped", flips->ball_faces_swapped);
  report.note(fmt::format(
      "surroundings at 2000 radii; at 50 radii, where the map's one centre shows: ball {:.4f}, box {:.4f}",
      flips->ball_at_50_radii, flips->box_at_50_radii));
  return Done{};
}

}  // namespace

void add_frame(Benches& benches) {
  benches.add({"frame",
               "a frame of the paper's city with and without reflections, its culling, mirrors "
               "against the ray tracer",
               in_context(measure)});
}

}  // namespace parvis::bench
