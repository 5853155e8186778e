#include "bench/environment_rays/view_error.h"

#include <algorithm>
#include <numeric>

#include "bench/flip_between.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/methods/settings.h"

namespace parvis::bench {
namespace {

constexpr float crossing_reach_m = 15.0f;

/// Lanes end at crossings.
bool is_at_crossing(const scene::Scene& scene, glm::vec3 at) {
  return std::ranges::any_of(scene.roads.lanes, [&](const scene::Lane& lane) {
    return glm::distance(lane.points.front(), at) < crossing_reach_m ||
           glm::distance(lane.points.back(), at) < crossing_reach_m;
  });
}

reference::TracedPicture traced_with_exact_shadows(house::Stage& stage, const NearView& view, int width,
                                                   int height, int samples_per_pixel) {
  render::Renderer& renderer = stage.renderer();
  renderer.begin_frame(stage.scene(), view.camera);
  shading::DrawnLight light = renderer.drawn_light();
  light.has_exact_shadows = true;
  reference::TraceOptions options;
  options.samples_per_pixel = samples_per_pixel;
  options.window = view.window;
  options.drawn_light = &light;
  options.mirror_bounces = methods::settings(stage.scene()).bounces;
  const reference::RayScene rays(stage.scene());
  return reference::trace_picture(rays, stage.scene(), renderer.sky(), view.camera, width, height, options);
}

/// FLIP of each picture inside the reflective pixels.
Result<std::vector<double>> flips_of(const std::vector<Image8>& pictures,
                                     const reference::TracedPicture& truth, float exposure) {
  const Image8 expected = shading::tone_mapped_picture(truth.radiance, exposure);
  std::vector<double> flips;
  flips.reserve(pictures.size());
  for (const Image8& picture : pictures) {
    const Result<double> flip = flip_between(picture, expected, truth.mirror_mask);
    if (!flip) return flip.errors();
    flips.push_back(*flip);
  }
  return flips;
}

}  // namespace

Result<std::vector<ViewFlips>> flips_of_methods(house::Stage& stage, const std::vector<JudgedMethod>& methods,
                                                std::size_t views, int width, int height,
                                                const NearViewWish& wish, const Truth& truth,
                                                const std::function<Status(const NearView&)>& also) {
  NearViews near_views(stage, width, height, wish);
  std::vector<ViewFlips> flips;
  flips.reserve(views);
  std::vector<Image8> pictures;
  pictures.reserve(methods.size());
  for (std::size_t i = 0; i < views; ++i) {
    const Result<NearView> view = near_views.next();
    if (!view) return view.errors();
    pictures.clear();
    for (const JudgedMethod& method : methods) {
      Result<Image8> picture = picture_of(stage, method, view->camera, width, height, view->window);
      if (!picture) return picture.errors();
      pictures.push_back(*std::move(picture));
    }
    const float exposure = stage.scene().exposure;
    Result<std::vector<double>> of_method = flips_of(
        pictures, stage.trace(view->camera, width, height, truth.samples_per_pixel, view->window), exposure);
    if (!of_method) return of_method.errors();
    flips.push_back({is_at_crossing(stage.scene(), view->car), *std::move(of_method)});
    if (truth.also_has_exact_shadows) {
      Result<std::vector<double>> exactly =
          flips_of(pictures, traced_with_exact_shadows(stage, *view, width, height, truth.samples_per_pixel),
                   exposure);
      if (!exactly) return exactly.errors();
      flips.back().exactly = *std::move(exactly);
    }
    if (also)
      if (Status status = also(*view); !status) return status.errors();
  }
  return flips;
}

double mean_flip(const std::vector<ViewFlips>& views, std::size_t method) {
  return std::accumulate(views.begin(), views.end(), 0.0,
                         [&](double sum, const ViewFlips& view) { return sum + view.of_method[method]; }) /
         double(std::max(views.size(), std::size_t{1}));
}

double worst_ratio(const std::vector<ViewFlips>& views, std::size_t method, std::size_t over) {
  double worst = 0.0;
  for (const ViewFlips& view : views) worst = std::max(worst, view.of_method[method] / view.of_method[over]);
  return worst;
}

void note_flips(const std::vector<JudgedMethod>& methods, const std::vector<ViewFlips>& views,
                Report& report) {
  for (std::size_t m = 0; m < methods.size(); ++m) {
    std::string row = fmt::format("FLIP {}: mean {:.4f}, views", methods[m].name, mean_flip(views, m));
    for (const ViewFlips& view : views) row += fmt::format(" {:.3f}", view.of_method[m]);
    report.note(row);
  }
}

}  // namespace parvis::bench
