#include "bench/environment_rays/near_costs.h"

#include <algorithm>

#include "bench/environment_rays/timed_pictures.h"
#include "bench/environment_rays/view_error.h"
#include "bench/reflection_cost.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 720;
constexpr double min_rerendered = 10.0;
constexpr double max_flip_over_rerendered = 0.8;  // of the worst view, where cars are judged one by one

enum Method : std::size_t { none, mem, traced, local, full, lod };

std::string list(const char* name, const std::vector<double>& values) {
  std::string row = name;
  for (const double value : values) row += fmt::format(" {:.1f}", value);
  return row;
}

void note_costs(const char* where, const NearCosts& near, Report& report) {
  const double car_ms = ratio_in_turn(near.rerendered_ms(), near.seen).value;
  report.note(fmt::format(
      "{}: {}, {}, {}, {}, {}, {}; a re-rendered car {:.1f} ms", where, list("cars seen", near.seen),
      list("mem ms", near.mem_ms), list("traced ms", near.traced_ms), list("local ms", near.local_ms),
      list("re-rendered ms", near.full_ms), list("with levels of detail ms", near.lod_ms), car_ms));
}

}  // namespace

Result<NearTimer> NearTimer::create(house::Stage& stage, const methods::Settings& shipped, int repeats) {
  Result<std::vector<JudgedMethod>> methods =
      judged_methods(stage, {{"none", methods::Settings{"none"}},
                             {"mem", shipped},
                             {"traced", methods::Settings{"traced"}},
                             {"local", {"local_environment_maps", 128, false}},
                             {"rerendered", {"rerendered_cube_map", 128, false}},
                             {"rerendered_lod", {"rerendered_cube_map", 128, true}}});
  if (!methods) return methods.errors();
  return NearTimer(stage, *std::move(methods), repeats);
}

Status NearTimer::time(const NearView& view) {
  const Result<std::vector<ReflectionCost>> costs = reflection_costs(
      *stage_, methods_, view.camera, width, height, repeats_, Frames::left_out, timed_step_s);
  if (!costs) return costs.errors();
  for (const auto& [method, samples] : {std::pair{mem, &costs_.mem_ms},
                                        {traced, &costs_.traced_ms},
                                        {local, &costs_.local_ms},
                                        {full, &costs_.full_ms},
                                        {lod, &costs_.lod_ms}})
    samples->push_back(median((*costs)[method].ms).value);
  const int faces = std::max(methods_[full].reflections->faces_drawn(), 1);
  costs_.seen.push_back(double(faces) / 6.0);
  costs_.face_ms.push_back(costs_.full_ms.back() / faces);
  return Done{};
}

Result<NearCosts> near_costs(house::Stage& stage, const methods::Settings& shipped, const NearViewWish& wish,
                             int views, int repeats) {
  Result<NearTimer> timer = NearTimer::create(stage, shipped, repeats);
  if (!timer) return timer.errors();
  NearViews near_views(stage, width, height, wish);
  for (int i = 0; i < views; ++i) {
    const Result<NearView> view = near_views.next();
    if (!view) return view.errors();
    if (Status status = timer->time(*view); !status) return status.errors();
  }
  return timer->costs();
}

Status measure_near_costs(house::Stage& stage, const methods::Settings& shipped, bool is_quick,
                          Report& report) {
  const int views = is_quick ? 3 : 8, repeats = is_quick ? 3 : 10;
  const int judged_width = is_quick ? width / 2 : width, judged_height = is_quick ? height / 2 : height;
  constexpr int cars_seen = 10;
  Result<NearTimer> timer = NearTimer::create(stage, shipped, repeats);
  if (!timer) return timer.errors();
  const std::vector<JudgedMethod>& methods = timer->methods();
  std::vector<double> shown_over_none, nothing_over_none;
  const auto also = [&](const NearView& view) -> Status {
    const Result<FlipOverNone> shown = flip_over_none(stage, {methods[mem], methods[none], methods[traced]},
                                                      view.camera, judged_width, judged_height, view.window);
    if (!shown) return shown.errors();
    shown_over_none.push_back(shown->timed), nothing_over_none.push_back(shown->none_again);
    return timer->time(view);
  };
  const Result<std::vector<ViewFlips>> flips = flips_of_methods(
      stage, methods, std::size_t(views), judged_width, judged_height, {cars_seen, "", 1.0f}, {}, also);
  if (!flips) return flips.errors();
  const NearCosts& near = timer->costs();
  note_costs("a near car, ten seen", near, report);
  note_flips(methods, *flips, report);
  const std::vector<double>& rerendered_ms = near.rerendered_ms();
  const std::size_t baseline = &rerendered_ms == &near.lod_ms ? lod : full;
  report.note(fmt::format("the baseline is {}", methods[baseline].name));

  constexpr Target wanted{min_rerendered, true};
  const double rerendered = ratio_in_turn(rerendered_ms, near.mem_ms).value;
  report.add("near_cost_ratio_rerendered_over_mem", rerendered, wanted);
  // Local maps are drawn for each car, as re-rendered ones are.
  report.add_control("near_cost_ratio_rerendered_over_local",
                     ratio_in_turn(rerendered_ms, near.local_ms).value, wanted);
  report.add("near_flip_ratio_mem_over_rerendered", mean_flip(*flips, mem) / mean_flip(*flips, baseline),
             up_to(max_flip_over_rerendered));
  report.add_control("near_flip_ratio_none_over_rerendered",
                     mean_flip(*flips, none) / mean_flip(*flips, baseline), up_to(max_flip_over_rerendered));
  report_shown({median(shown_over_none).value, median(nothing_over_none).value},
               "near_cost_flip_mem_over_none", report);
  report.add("traced_cost_over_mem_ten_seen", ratio_in_turn(near.traced_ms, near.mem_ms).value);
  report.add_control("traced_cost_over_mem_ten_re_rendered_in_its_place", rerendered, up_to(2.0));
  return Done{};
}

}  // namespace parvis::bench
