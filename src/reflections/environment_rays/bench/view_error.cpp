#include "reflections/environment_rays/bench/view_error.h"

#include <algorithm>
#include <numeric>

#include "graphics/reference/metrics.h"
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

reference::TracedPicture traced(house::Stage& stage, const NearView& view, int width, int height,
                                const Truth& truth) {
  if (!truth.has_exact_shadows)
    return stage.trace(view.camera, width, height, truth.samples_per_pixel, view.window);
  render::Renderer& renderer = stage.renderer();
  renderer.begin_frame(stage.scene(), view.camera);
  shading::DrawnLight light = renderer.drawn_light();
  light.has_exact_shadows = true;
  reference::TraceOptions options;
  options.samples_per_pixel = truth.samples_per_pixel;
  options.window = view.window;
  options.drawn_light = &light;
  options.mirror_bounces = methods::settings(stage.scene()).bounces;
  const reference::RayScene rays(stage.scene());
  return reference::trace_picture(rays, stage.scene(), renderer.sky(), view.camera, width, height, options);
}

}  // namespace

Result<std::vector<ViewFlips>> flips_of_methods(house::Stage& stage, const std::vector<JudgedMethod>& methods,
                                                std::size_t views, int width, int height,
                                                const NearViewWish& wish, const Truth& truth,
                                                const std::function<Status(const NearView&)>& also) {
  NearViews near_views(stage, width, height, wish);
  std::vector<ViewFlips> flips;
  for (std::size_t i = 0; i < views; ++i) {
    const Result<NearView> view = near_views.next();
    if (!view) return view.errors();
    if (also)
      if (Status status = also(*view); !status) return status.errors();
    const reference::TracedPicture right = traced(stage, *view, width, height, truth);
    const Image8 expected = shading::tone_mapped_picture(right.radiance, stage.scene().exposure);
    flips.push_back({is_at_crossing(stage.scene(), view->car), {}});
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Result<Image8> picture = picture_of(stage, methods[m], view->camera, width, height, view->window);
      if (!picture) return picture.errors();
      const Result<reference::Difference> difference =
          reference::compare(*picture, expected, right.mirror_mask);
      if (!difference) return difference.errors();
      flips.back().of_method.push_back(difference->flip);
    }
  }
  return flips;
}

double mean_flip(const std::vector<ViewFlips>& views, std::size_t method) {
  return std::accumulate(views.begin(), views.end(), 0.0,
                         [&](double sum, const ViewFlips& view) { return sum + view.of_method[method]; }) /
         double(std::max(views.size(), std::size_t{1}));
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
