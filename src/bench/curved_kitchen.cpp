#include "bench/curved_kitchen.h"

#include <algorithm>
#include <array>

#include "bench/judged_method.h"
#include "bench/reflected_points.h"
#include "bench/scratch_folder.h"
#include "city/kitchen.h"
#include "gl/context.h"
#include "reference/metrics.h"
#include "shading/tone_curve.h"

namespace parvis::bench {
namespace {

constexpr std::array cameras{"at the kettle", "figure 6", "into the bowl", "at the pans", "at the spoons"};
constexpr std::size_t quick_cameras = 1;  // hollows are drawn in many layers, each as slow as a picture
constexpr int width = 960, height = 600, quick_width = 480, quick_height = 300;
constexpr std::size_t points = 4000, quick_points = 400;  // a camera
constexpr int samples_a_pixel = 16;
constexpr int baseline_faces_px = 512;

Status measure_points(const stage::Stage& stage, bool is_quick, Report& report) {
  const Result<ReflectedPoints> reflected = ReflectedPoints::make(stage.scene());
  if (!reflected) return reflected.errors();
  std::vector<double> all;
  for (const char* name : cameras) {
    const Result<Camera> camera = stage.camera(name);
    if (!camera) return camera.errors();
    const std::vector<double> errors =
        reflected->errors_px(*camera, width, height, is_quick ? quick_points : points);
    if (errors.empty()) return error("the camera \"{}\" shows no mirror", name);
    const auto missed = std::ranges::count_if(errors, [](double px) { return px >= missed_px; });
    report.note(fmt::format(
        "{}: of what its mirrors show, {:.2f} % is missed; median, 95 %, 99 % {:.3f} {:.3f} {:.2f} px", name,
        100.0 * double(missed) / double(errors.size()), percentile(errors, 0.5), percentile(errors, 0.95),
        percentile(errors, 0.99)));
    all.insert(all.end(), errors.begin(), errors.end());
  }
  report.add("kitchen_p99_px", percentile(all, 0.99));
  return Done{};
}

Status measure_pictures(stage::Stage& stage, bool is_quick, Report& report) {
  const int w = is_quick ? quick_width : width, h = is_quick ? quick_height : height;
  scene::Reflection baseline = stage.scene().reflection;
  baseline.method = scene::ReflectionMethod::rerendered_cube_map;
  baseline.resolution = baseline_faces_px, baseline.uses_level_of_detail = false;
  std::vector<JudgedMethod> methods;
  for (const auto& [name, reflection] :
       {std::pair{"virtual objects", stage.scene().reflection}, {"rerendered cube maps", baseline}}) {
    Result<JudgedMethod> method = judged_method(stage, name, reflection);
    if (!method) return method.errors();
    methods.push_back(*std::move(method));
  }
  std::array<double, 2> sums{};
  for (std::size_t c = 0; c < (is_quick ? quick_cameras : cameras.size()); ++c) {
    const Result<Camera> camera = stage.camera(cameras[c]);
    if (!camera) return camera.errors();
    const reference::TracedPicture truth = stage.trace(*camera, w, h, samples_a_pixel);
    const Image8 expected = shading::tone_mapped_picture(truth.radiance, stage.scene().exposure);
    std::array<double, 2> flips{};
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Result<Image8> picture = picture_of(stage, methods[m], *camera, w, h, {0, 0, w, h});
      if (!picture) return picture.errors();
      const auto difference = reference::compare(*picture, expected, truth.mirror_mask);
      if (!difference) return difference.errors();
      sums[m] += flips[m] = difference->flip;
    }
    report.note(
        fmt::format("{}: FLIP in the mirrors {:.4f}, cube maps {:.4f}", cameras[c], flips[0], flips[1]));
  }
  report.add("kitchen_flip_over_rerendered", sums[0] / sums[1]);
  return Done{};
}

}  // namespace

Result<std::unique_ptr<stage::Stage>> open_kitchen(const std::filesystem::path& folder) {
  if (Status status = city::write_kitchen(folder, 1); !status) return status.errors();
  Result<stage::Play> play = stage::open_play(folder / "kitchen.xp", {});
  if (!play) return play.errors();
  return stage::Stage::create(*std::move(play));
}

Status measure_kitchen(bool is_quick, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  const ScratchFolder folder;
  Result<std::unique_ptr<stage::Stage>> stage = open_kitchen(folder.path);
  if (!stage) return stage.errors();
  if (Status status = measure_points(**stage, is_quick, report); !status) return status;
  return measure_pictures(**stage, is_quick, report);
}

}  // namespace parvis::bench
