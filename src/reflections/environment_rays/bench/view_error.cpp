#include "reflections/environment_rays/bench/view_error.h"

#include <algorithm>

#include "graphics/reference/metrics.h"
#include "graphics/shading/tone_curve.h"
#include "reflections/environment_rays/bench/near_views.h"

namespace parvis::bench {
namespace {

constexpr int samples_per_pixel = 16;
constexpr float crossing_reach_m = 15.0f;

/// Lanes end at crossings.
bool is_at_crossing(const scene::Scene& scene, glm::vec3 at) {
  return std::ranges::any_of(scene.roads.lanes, [&](const scene::Lane& lane) {
    return glm::distance(lane.points.front(), at) < crossing_reach_m ||
           glm::distance(lane.points.back(), at) < crossing_reach_m;
  });
}

}  // namespace

Result<std::vector<ViewFlips>> flips_of_methods(house::Stage& stage, const std::vector<JudgedMethod>& methods,
                                                std::size_t views, int width, int height) {
  NearViews near_views(stage, width, height);
  std::vector<ViewFlips> flips;
  for (std::size_t i = 0; i < views; ++i) {
    const Result<NearView> view = near_views.next();
    if (!view) return view.errors();
    const reference::TracedPicture truth =
        stage.trace(view->camera, width, height, samples_per_pixel, view->window);
    const Image8 expected = shading::tone_mapped_picture(truth.radiance, stage.scene().exposure);
    flips.push_back({is_at_crossing(stage.scene(), view->car), {}});
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Result<Image8> picture = picture_of(stage, methods[m], view->camera, width, height, view->window);
      if (!picture) return picture.errors();
      const Result<reference::Difference> difference =
          reference::compare(*picture, expected, truth.mirror_mask);
      if (!difference) return difference.errors();
      flips.back().of_method.push_back(difference->flip);
    }
  }
  return flips;
}

}  // namespace parvis::bench
