#include "bench/virtual_objects/frames.h"

#include <array>
#include <ctime>

#include "bench/judged_method.h"
#include "bench/virtual_objects/beside_rerendered.h"
#include "reflections/virtual_objects/search_settings.h"

namespace parvis::bench {
namespace {

/// The second also shows the bowl's concave side and its rim: each is drawn in 17 layers.
constexpr std::array cameras{"bowl in the kettle", "at the kettle"};
constexpr int width = 480, height = 300;
constexpr int turns = 2;  // each frame takes seconds in software

std::vector<std::pair<std::string, methods::Settings>> ways_to_reflect(const scene::Scene& scene) {
  const methods::Settings& by_area = methods::settings(scene);
  methods::Settings every = by_area;
  every.uses_level_of_detail = false;
  std::vector<std::pair<std::string, methods::Settings>> variants{{"every vertex", every}};
  for (const float share : {0.143f, 0.096f, 0.055f, 0.041f}) {
    methods::Settings grid = every;
    grid.own.get<virtual_objects::SearchSettings>().grid_share = share;
    variants.emplace_back(fmt::format("a grid of {:.1f} %", 100.0f * share), grid);
  }
  variants.emplace_back("grids by area", by_area);
  variants.emplace_back("re-rendered cube maps", rerendered_baseline(scene));
  return variants;
}

Status measure_view(house::Stage& stage, const std::vector<JudgedMethod>& methods, const char* name,
                    Report& report) {
  const Result<Camera> camera = stage.camera(name);
  if (!camera) return camera.errors();
  std::vector<std::vector<double>> frame_s(methods.size()), processor_s(methods.size());
  for (int turn = -1; turn < turns; ++turn)  // the first makes what is made once
    for (std::size_t m = 0; m < methods.size(); ++m) {
      if (Status status = stage.renderer().set_reflection(methods[m].reflections.get()); !status)
        return status;
      glFinish();
      const std::clock_t begun = std::clock();
      Status drawn = Done{};
      const double ms = milliseconds([&] {
        drawn = draw_again(stage, methods[m], *camera, width, height);
        glFinish();
      });
      if (!drawn) return drawn;
      if (turn < 0) continue;
      frame_s[m].push_back(1e-3 * ms);
      processor_s[m].push_back(double(std::clock() - begun) / CLOCKS_PER_SEC);
    }
  for (std::size_t m = 0; m < methods.size(); ++m)
    report.note(fmt::format("{}, {} x {}, {}: {:.2f} s a frame, {:.2f} s of processors", name, width, height,
                            methods[m].name, median(frame_s[m]).value, median(processor_s[m]).value));
  return Done{};
}

}  // namespace

Status measure_frames(house::Stage& stage, Report& report) {
  const Result<std::vector<JudgedMethod>> methods = judged_methods(stage, ways_to_reflect(stage.scene()));
  if (!methods) return methods.errors();
  for (const char* name : cameras)
    if (Status status = measure_view(stage, *methods, name, report); !status) return status;
  return Done{};
}

}  // namespace parvis::bench
