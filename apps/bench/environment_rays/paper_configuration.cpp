#include "bench/environment_rays/paper_configuration.h"

#include "bench/environment_rays/timed_pictures.h"
#include "bench/environment_rays/view_error.h"
#include "bench/reflection_cost.h"
#include "bench/street_views.h"
#include "reflections/reference_maps/placement.h"
#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 720;
constexpr int map_count = 54, map_pixels = 128, vehicles = 30, cars_for_cost = 120, seen_min = 8,
              seen_max = 12;
constexpr int near_repeats = 2;  // of each near view, of which there are several
constexpr double step_s = 0.1;   // between frames that are timed: every car has moved

/// The city as the paper's: traffic and maps along all roads.
scene::Scene whole_city(const scene::Scene& city) {
  scene::Scene scene = driven_everywhere(city);
  const reference_maps::HeightPyramid heights(reference_maps::heights_of(scene));
  reference_maps::ReferenceMapPlan& plan = reference_maps::map_plan(scene);
  plan.places = reference_maps::spread_places(scene, heights, map_count);
  plan.resolution = map_pixels;
  return scene;
}

}  // namespace

scene::Scene driven_everywhere(const scene::Scene& city) {
  scene::Scene scene = city;  // models are shared
  scene.data<scene::DrivingArea>() = {};
  return scene;
}

Status measure_paper_configuration(const House& house, const scene::Scene& city, bool is_quick,
                                   Report& report) {
  const methods::Settings local{"local_environment_maps", map_pixels, true},
      rerendered{"rerendered_cube_map", map_pixels, false},
      rerendered_lod{"rerendered_cube_map", map_pixels, true}, none{"none"};
  const scene::Scene scene = whole_city(city);
  if (Status kept = keep_maps(house, scene, local); !kept) return kept;
  const auto made = [&](house::Stage& stage) {
    return judged_methods(
        stage,
        {{"none", none}, {"paper", local}, {"rerendered", rerendered}, {"rerendered_lod", rerendered_lod}});
  };
  Result<std::unique_ptr<house::Stage>> stage = house::Stage::create(play_with(house, scene, vehicles));
  if (!stage) return stage.errors();
  const Result<std::vector<JudgedMethod>> judged = made(**stage);
  if (!judged) return judged.errors();
  std::vector<std::vector<double>> near_ms(judged->size());
  const auto time = [&](const NearView& view) -> Status {
    const Result<std::vector<ReflectionCost>> costs = reflection_costs(
        **stage, *judged, view.camera, width, height, near_repeats, Frames::left_out, step_s);
    if (!costs) return costs.errors();
    for (std::size_t m = 0; m < near_ms.size(); ++m) near_ms[m].push_back(median((*costs)[m].ms).value);
    return Done{};
  };
  const Result<std::vector<ViewFlips>> views =
      is_quick ? flips_of_methods(**stage, *judged, 6, width / 2, height / 2, {}, {}, time)
               : flips_of_methods(**stage, *judged, 20, width, height, {}, {}, time);
  if (!views) return views.errors();
  report.note(fmt::format("the paper's configuration: {} maps of {} pixels over {} lanes", map_count,
                          map_pixels, scene.roads.lanes.size()));
  note_flips(*judged, *views, report);

  Result<std::unique_ptr<house::Stage>> crowded =
      house::Stage::create(play_with(house, scene, cars_for_cost));
  if (!crowded) return crowded.errors();
  const Result<Camera> camera = view_of_cars(**crowded, seen_min, seen_max, width, height, report);
  if (!camera) return camera.errors();
  const Result<std::vector<JudgedMethod>> timed = made(**crowded);
  if (!timed) return timed.errors();
  const Result<std::vector<ReflectionCost>> costs = reflection_costs(
      **crowded, *timed, *camera, width, height, is_quick ? 5 : 20, Frames::left_out, step_s);
  if (!costs) return costs.errors();
  for (std::size_t m = 1; m < timed->size(); ++m)
    report.note(fmt::format("{}, cars moving: {:.1f} ms from above, {:.1f} ms in the near views",
                            (*timed)[m].name, median((*costs)[m].ms).value, median(near_ms[m]).value));
  // Re-rendered maps at their best, with levels of detail or without: of both the cost and the FLIP.
  const std::size_t baseline = median((*costs)[3].ms).value < median((*costs)[2].ms).value ? 3 : 2;
  report.note(fmt::format("the baseline is {}", (*timed)[baseline].name));
  const double rerendered_flip = mean_flip(*views, baseline);
  const double paper = mean_flip(*views, 1) / rerendered_flip;
  report.add("paper_flip_ratio", paper);
  report.add_control("paper_flip_ratio_without_reflections", mean_flip(*views, 0) / rerendered_flip,
                     up_to(paper));
  const std::vector<double>& rerendered_ms = (*costs)[baseline].ms;
  const Median cost_ratio = ratio_in_turn(rerendered_ms, (*costs)[1].ms);
  report.add("paper_cost_ratio", cost_ratio);
  report.add("paper_cost_ratio_near", ratio_in_turn(near_ms[baseline], near_ms[1]));
  // By how much re-rendered maps differ from themselves, one sample from the one before.
  report.add_control("paper_cost_ratio_of_rerendered_over_itself",
                     ratio_in_turn({rerendered_ms.begin() + 1, rerendered_ms.end()},
                                   {rerendered_ms.begin(), rerendered_ms.end() - 1})
                         .value,
                     {cost_ratio.value, true});
  const Result<JudgedMethod> rays = judged_method(**crowded, "traced", methods::Settings{"traced"});
  if (!rays) return rays.errors();
  const Result<FlipOverNone> flip = flip_over_none(**crowded, {(*timed)[1], (*timed)[0], *rays}, *camera,
                                                   width, height, {0, 0, width, height});
  if (!flip) return flip.errors();
  report_shown(*flip, "paper_cost_flip_over_none", report);
  return Done{};
}

}  // namespace parvis::bench
