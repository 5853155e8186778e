#include "bench/virtual_objects/beside_rerendered.h"

#include <array>

#include "bench/flip_between.h"
#include "bench/judged_method.h"
#include "graphics/shading/tone_curve.h"

namespace parvis::bench {
namespace {

constexpr int samples_per_pixel = 16;

}  // namespace

methods::Settings rerendered_baseline(const scene::Scene& scene) {
  methods::Settings baseline = methods::settings(scene);
  baseline.method = "rerendered_cube_map";
  baseline.resolution = 512, baseline.uses_level_of_detail = false;
  return baseline;
}

Status measure_beside_rerendered(house::Stage& stage, std::span<const char* const> cameras, int width,
                                 int height, const std::string& key, double max_ratio, Report& report) {
  const Result<std::vector<JudgedMethod>> methods =
      judged_methods(stage, {{"virtual objects", methods::settings(stage.scene())},
                             {"rerendered cube maps", rerendered_baseline(stage.scene())},
                             {"none", methods::Settings{"none"}}});
  if (!methods) return methods.errors();
  std::array<double, 3> sums{};
  for (const char* name : cameras) {
    const Result<Camera> camera = stage.camera(name);
    if (!camera) return camera.errors();
    const reference::TracedPicture truth = stage.trace(*camera, width, height, samples_per_pixel);
    const Image8 expected = shading::tone_mapped_picture(truth.radiance, stage.scene().exposure);
    std::array<double, 3> flips{};
    for (std::size_t m = 0; m < methods->size(); ++m) {
      const Result<double> flip =
          flip_between(picture_of(stage, (*methods)[m], *camera, width, height, {0, 0, width, height}),
                       expected, truth.mirror_mask);
      if (!flip) return flip.errors();
      sums[m] += flips[m] = *flip;
    }
    report.note(fmt::format("{}: FLIP inside {:.4f}, cube maps {:.4f}, without reflections {:.4f}", name,
                            flips[0], flips[1], flips[2]));
  }
  report.add(key, sums[0] / sums[1], up_to(max_ratio));
  report.add_control(key + "_without_reflections", sums[2] / sums[1], up_to(max_ratio));
  return Done{};
}

}  // namespace parvis::bench
