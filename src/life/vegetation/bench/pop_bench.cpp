#include "life/vegetation/bench/pop_bench.h"

#include <algorithm>
#include <cmath>

#include "graphics/reference/metrics.h"

namespace parvis::bench {
namespace {

using vegetation::PlantDetail;

/// A step of a viewer: a fiftieth of the way to the tree, as a walker's in a tenth of a second from seven
/// metres.
constexpr float nearer = 0.98f;
/// Where leaves of 5 to 8 pixels change from points to coarse ones, one by one, a transition without blending
/// would change all of them at once: the control takes that way in one step.
constexpr float nearer_at_once = 5.0f / 8.0f;
constexpr float farthest_m = 45.0f, nearest_m = 7.0f;
constexpr float angle = 0.32f;  ///< so narrow that the crown fills the picture where forms change

Camera looking_at(glm::vec3 crown, float distance_m) {
  Camera camera;
  camera.world_from_camera = look_at(crown + glm::vec3(0.0f, -distance_m, 0.0f), crown);
  camera.vertical_fov = angle;
  return camera;
}

/// The detail by which a picture of `camera` shows plants as if its resolution were smaller by `scale`, below
/// 1: the largest budget that is kept by no larger a factor.
PlantDetail detail_at(const Grove& grove, const Camera& camera, float scale) {
  constexpr int no_budget = 1 << 30;
  PlantDetail few, many;
  few.max_primitives = 1, many.max_primitives = no_budget;
  while (many.max_primitives - few.max_primitives > 1) {
    PlantDetail middle;
    middle.max_primitives = few.max_primitives + (many.max_primitives - few.max_primitives) / 2;
    (grove.chosen(camera, middle).scale <= scale ? few : many) = middle;
  }
  return few;
}

/// FLIP between the picture of a camera and the same with the forms that the tree had `step` of the way ago:
/// what changes by the forms alone, while nothing in the picture moves.
Result<double> pop(Grove& grove, glm::vec3 crown, float distance_m, float step) {
  const Camera now = looking_at(crown, distance_m), before = looking_at(crown, distance_m / step);
  const Result<Image8> picture = grove.picture(now);
  if (!picture) return picture.errors();
  const float scale_before = step * grove.chosen(before, {}).scale;
  const Result<Image8> with_forms_before = grove.picture(now, detail_at(grove, now, scale_before));
  if (!with_forms_before) return with_forms_before.errors();
  const Result<reference::Difference> difference = reference::compare(*picture, *with_forms_before);
  if (!difference) return difference.errors();
  return difference->flip;
}

}  // namespace

Status measure_pops(const BenchSetup& setup, Grove& grove, Report& report) {
  const Target no_pop = up_to(0.02);
  const int places = setup.is_quick ? 8 : 24;
  const glm::vec3 crown = grove.show_one();
  grove.let_cast(false);  // maps of shadows would follow the budget that stands for a farther view
  double largest = 0.0, largest_at_once = 0.0, largest_at_m = 0.0;
  for (int i = 0; i < places; ++i) {
    const float distance_m =
        farthest_m * std::pow(nearest_m / farthest_m, float(i) / float(std::max(places - 1, 1)));
    const Result<double> flip = pop(grove, crown, distance_m, nearer),
                         at_once = pop(grove, crown, distance_m, nearer_at_once);
    if (!flip) return flip.errors();
    if (!at_once) return at_once.errors();
    if (*flip > largest) largest = *flip, largest_at_m = double(distance_m);
    largest_at_once = std::max(largest_at_once, *at_once);
  }
  grove.show_rows(Grove::rows);
  grove.let_cast(true);
  if (!(largest > 0.0)) return error("no form of the tree changes from {} m to {} m", farthest_m, nearest_m);
  report.add("vegetation_pop_flip", largest, no_pop);
  report.add_control("vegetation_pop_flip_without_blending", largest_at_once, no_pop);
  report.note(fmt::format(
      "vegetation_pop_flip: an oak from {:.0f} to {:.0f} m, {} places; the same view with the "
      "forms of now and of {:.0f} % of the way before, largest at {:.1f} m; no shadows; control: the forms "
      "change in one step where they change over leaves of 5 to 8 pixels",
      farthest_m, nearest_m, places, 100.0f * (1.0f - nearer), largest_at_m));
  return Done{};
}

}  // namespace parvis::bench
