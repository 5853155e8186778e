#include "reflections/environment_rays/bench/paper_configuration.h"

#include "bench/reflection_cost.h"
#include "bench/street_views.h"
#include "reflections/environment_rays/bench/timed_pictures.h"
#include "reflections/environment_rays/bench/view_error.h"
#include "reflections/reference_maps/placement.h"
#include "reflections/reference_maps/scene_maps.h"
#include "reflections/reference_maps/settings.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 720;
constexpr int map_count = 54, map_pixels = 128, vehicles = 30, cars_for_cost = 120, seen_min = 8,
              seen_max = 12;
constexpr double step_s = 0.1;  // between frames that are timed: every car has moved

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
      rerendered{"rerendered_cube_map", map_pixels, false}, none{"none"};
  const scene::Scene scene = whole_city(city);
  if (Status kept = keep_maps(house, scene, local); !kept) return kept;
  const auto made = [&](house::Stage& stage) -> Result<std::vector<JudgedMethod>> {
    std::vector<JudgedMethod> methods;
    for (const auto& [name, reflection] :
         {std::pair{"none", none}, {"paper", local}, {"rerendered", rerendered}}) {
      Result<JudgedMethod> method = judged_method(stage, name, reflection);
      if (!method) return method.errors();
      methods.push_back(*std::move(method));
    }
    return methods;
  };
  Result<std::unique_ptr<house::Stage>> stage = house::Stage::create(play_with(house, scene, vehicles));
  if (!stage) return stage.errors();
  const Result<std::vector<JudgedMethod>> judged = made(**stage);
  if (!judged) return judged.errors();
  const Result<std::vector<ViewFlips>> views =
      is_quick ? flips_of_methods(**stage, *judged, 6, width / 2, height / 2)
               : flips_of_methods(**stage, *judged, 20, width, height);
  if (!views) return views.errors();
  report.note(fmt::format("the paper's configuration: {} maps of {} pixels over {} lanes", map_count,
                          map_pixels, scene.roads.lanes.size()));
  note_flips(*judged, *views, report);
  const double rerendered_flip = mean_flip(*views, 2);
  const double paper = mean_flip(*views, 1) / rerendered_flip;
  report.add("paper_flip_ratio", paper);
  report.add_control("paper_flip_ratio_without_reflections", mean_flip(*views, 0) / rerendered_flip,
                     up_to(paper));

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
    report.note(fmt::format("{}, cars moving: {:.1f} ms", (*timed)[m].name, median((*costs)[m].ms).value));
  const std::vector<double>& rerendered_ms = (*costs)[2].ms;
  const Median cost_ratio = ratio_in_turn(rerendered_ms, (*costs)[1].ms);
  report.add("paper_cost_ratio", cost_ratio);
  // By how much re-rendered maps differ from themselves, one sample from the one before.
  report.add_control("paper_cost_ratio_of_rerendered_over_itself",
                     ratio_in_turn({rerendered_ms.begin() + 1, rerendered_ms.end()},
                                   {rerendered_ms.begin(), rerendered_ms.end() - 1})
                         .value,
                     {cost_ratio.value, true});
  const Result<JudgedMethod> rays = judged_method(**crowded, "traced", methods::Settings{"traced"});
  if (!rays) return rays.errors();
  const Result<double> flip = flip_over_none(**crowded, {(*timed)[1], (*timed)[0], *rays}, *camera, width,
                                             height, {0, 0, width, height});
  if (!flip) return flip.errors();
  report.add("paper_cost_flip_over_none", *flip, shows_reflections);
  return Done{};
}

}  // namespace parvis::bench
