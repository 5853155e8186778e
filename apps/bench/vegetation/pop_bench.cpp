#include "bench/vegetation/pop_bench.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "bench/flip_between.h"

namespace parvis::bench {
namespace {

/// A step of a viewer: a fiftieth of the way to the tree, as a walker's in a tenth of a second from seven
/// metres.
constexpr float nearer = 0.98f;
/// Where leaves of 5 to 8 pixels change from points to coarse ones, one by one, a transition without blending
/// would change all of them at once: the control takes that way in one step.
constexpr float nearer_at_once = 5.0f / 8.0f;
constexpr float farthest_m = 45.0f, nearest_m = 7.0f;
constexpr float angle = 0.32f;  ///< so narrow that the crown fills the picture where forms change
/// A step of a viewer who looks round in twelve seconds: what is turned in a tenth of a second.
constexpr float turn_deg = 3.0f;
constexpr int steps_round = 120;
constexpr Target no_pop = {0.02, false};

Camera looking_at(glm::vec3 crown, float distance_m) {
  Camera camera;
  camera.world_from_camera = look_at(crown + glm::vec3(0.0f, -distance_m, 0.0f), crown);
  camera.vertical_fov = angle;
  return camera;
}

/// FLIP between the picture of a camera and the same with the forms of another scale of the resolution: what
/// changes by the forms alone, while nothing in the picture moves.
Result<double> pop(Grove& grove, const Camera& camera, float other_scale) {
  const Result<Image8> picture = grove.picture(camera),
                       with_other_forms = grove.picture(camera, grove.detail_at(camera, other_scale));
  if (!with_other_forms) return with_other_forms.errors();
  return flip_between(picture, *with_other_forms);
}

/// The largest pops of many views.
struct Pops {
  double flip = 0.0, at_once = 0.0;  ///< of the step before; of forms that change in one step
  std::size_t view = 0;              ///< that has the largest `flip`
};

/// A view after a step, and by which the resolution that forms go by is smaller: there, before the step, and
/// before one of all that forms change over.
struct Step {
  Camera camera;
  float scale, scale_before, scale_at_once;

  /// A factor's logarithm.
  float change() const { return std::abs(std::log(scale / scale_before)); }
};

Result<Pops> largest_pops(Grove& grove, const std::vector<Step>& steps) {
  Pops largest;
  for (std::size_t s = 0; s < steps.size(); ++s) {
    const Step& step = steps[s];
    const Result<double> flip = pop(grove, step.camera, step.scale_before),
                         at_once = pop(grove, step.camera, step.scale_at_once);
    if (!flip) return flip.errors();
    if (!at_once) return at_once.errors();
    if (*flip > largest.flip) largest.flip = *flip, largest.view = s;
    largest.at_once = std::max(largest.at_once, *at_once);
  }
  return largest;
}

float distance_at(int place, int places) {
  return farthest_m * std::pow(nearest_m / farthest_m, float(place) / float(std::max(places - 1, 1)));
}

/// One tree, from afar to near: its forms change by its size alone.
Status measure_approach(bool is_quick, Grove& grove, Report& report) {
  const int places = is_quick ? 8 : 24;
  const glm::vec3 crown = grove.show_one();
  std::vector<Step> steps;
  steps.reserve(std::size_t(places));
  for (int i = 0; i < places; ++i) {
    const float distance_m = distance_at(i, places);
    const Camera now = looking_at(crown, distance_m);
    const auto before = [&](float share) {
      return share * grove.chosen(looking_at(crown, distance_m / share), {}).scale;
    };
    steps.push_back({now, grove.chosen(now, {}).scale, before(nearer), before(nearer_at_once)});
  }
  const Result<Pops> pops = largest_pops(grove, steps);
  grove.show_rows(Grove::rows);
  if (!pops) return pops.errors();
  if (!(pops->flip > 0.0))
    return error("no form of the tree changes from {} m to {} m", farthest_m, nearest_m);
  report.add("vegetation_pop_flip", pops->flip, no_pop);
  report.add_control("vegetation_pop_flip_without_blending", pops->at_once, no_pop);
  report.note(fmt::format(
      "vegetation_pop_flip: an oak from {:.0f} to {:.0f} m, {} places; the same view with the "
      "forms of now and of {:.0f} % of the way before, largest at {:.1f} m; no shadows; control: the forms "
      "change in one step where they change over leaves of 5 to 8 pixels",
      farthest_m, nearest_m, places, 100.0f * (1.0f - nearer), distance_at(int(pops->view), places)));
  return Done{};
}

/// Under the first trees: the lawn lies on one side, the grove on the other.
Camera looking_round(int step) {
  constexpr glm::vec3 eye{5.0f, 5.0f, 1.7f};
  const float heading = glm::radians(turn_deg * float(step));
  Camera camera;
  camera.world_from_camera = look_at(eye, eye + glm::vec3(std::sin(heading), std::cos(heading), 0.04f));
  return camera;
}

/// All trees, around a viewer who turns: what comes into view takes from the budget of what is there.
Status measure_turning(bool is_quick, Grove& grove, Report& report) {
  std::vector<Step> steps;
  steps.reserve(steps_round);
  float before = grove.chosen(looking_round(-1), {}).scale;
  for (int i = 0; i < steps_round; ++i) {
    const Camera now = looking_round(i);
    const float scale = grove.chosen(now, {}).scale;
    steps.push_back({now, scale, before, nearer_at_once * scale});
    before = scale;
  }
  std::ranges::sort(steps, std::greater<>(), &Step::change);
  if (!(steps.front().change() > 0.0f))
    return error("the budget of primitives changes no form as a viewer turns round");
  steps.resize(is_quick ? 3 : 12);
  const Result<Pops> pops = largest_pops(grove, steps);
  if (!pops) return pops.errors();
  const Step& worst = steps[pops->view];
  report.add("vegetation_pop_flip_turning", pops->flip, no_pop);
  report.add_control("vegetation_pop_flip_turning_without_blending", pops->at_once, no_pop);
  report.note(fmt::format(
      "vegetation_pop_flip_turning: under the first trees, the {} of {} steps of {} degrees round at which "
      "the budget changes the forms most; the same view with the forms of now and of the step before, "
      "largest where the budget went from {:.3f} of the resolution to {:.3f}; no shadows; control as above",
      steps.size(), steps_round, turn_deg, worst.scale_before, worst.scale));
  return Done{};
}

}  // namespace

Status measure_pops(const BenchSetup& setup, Grove& grove, Report& report) {
  grove.let_cast(false);  // maps of shadows would follow the budget that stands for another view
  Status status = measure_approach(setup.is_quick, grove, report);
  if (status) status = measure_turning(setup.is_quick, grove, report);
  grove.let_cast(true);
  return status;
}

}  // namespace parvis::bench
