#include "reflections/virtual_objects/bench/beside_rerendered.h"

#include <array>

#include "bench/judged_method.h"
#include "graphics/reference/metrics.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {
namespace {

constexpr int samples_per_pixel = 16;
constexpr int baseline_faces_px = 512;

}  // namespace

Status measure_beside_rerendered(house::Stage& stage, std::span<const char* const> cameras, int width,
                                 int height, const std::string& key, double max_ratio, Report& report) {
  methods::Settings baseline = methods::settings(stage.scene());
  baseline.method = "rerendered_cube_map";
  baseline.resolution = baseline_faces_px, baseline.uses_level_of_detail = false;
  std::vector<JudgedMethod> methods;
  for (const auto& [name, reflection] : {std::pair{"virtual objects", methods::settings(stage.scene())},
                                         {"rerendered cube maps", baseline},
                                         {"none", methods::Settings{"none"}}}) {
    Result<JudgedMethod> method = judged_method(stage, name, reflection);
    if (!method) return method.errors();
    methods.push_back(*std::move(method));
  }
  std::array<double, 3> sums{};
  for (const char* name : cameras) {
    const Result<Camera> camera = stage.camera(name);
    if (!camera) return camera.errors();
    const reference::TracedPicture truth = stage.trace(*camera, width, height, samples_per_pixel);
    const Image8 expected = shading::tone_mapped_picture(truth.radiance, stage.scene().exposure);
    std::array<double, 3> flips{};
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Result<Image8> picture =
          picture_of(stage, methods[m], *camera, width, height, {0, 0, width, height});
      if (!picture) return picture.errors();
      const auto difference = reference::compare(*picture, expected, truth.mirror_mask);
      if (!difference) return difference.errors();
      sums[m] += flips[m] = difference->flip;
    }
    report.note(fmt::format("{}: FLIP inside {:.4f}, cube maps {:.4f}, without reflections {:.4f}", name,
                            flips[0], flips[1], flips[2]));
  }
  report.add(key, sums[0] / sums[1], up_to(max_ratio));
  report.add_control(key + "_without_reflections", sums[2] / sums[1], up_to(max_ratio));
  return Done{};
}

}  // namespace parvis::bench
