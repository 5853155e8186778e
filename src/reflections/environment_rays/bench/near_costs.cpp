#include "reflections/environment_rays/bench/near_costs.h"

#include <algorithm>

#include "bench/reflection_cost.h"
#include "reflections/environment_rays/bench/timed_pictures.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 720;
constexpr double min_rerendered = 10.0;

std::string list(const char* name, const std::vector<double>& values) {
  std::string row = name;
  for (const double value : values) row += fmt::format(" {:.1f}", value);
  return row;
}

void note_costs(const char* where, const NearCosts& near, Report& report) {
  report.note(fmt::format("{}: {}, {}, {}, {}; a re-rendered face {:.2f} ms, so a car {:.1f} ms", where,
                          list("cars seen", near.seen), list("mem ms", near.mem_ms),
                          list("traced ms", near.traced_ms), list("re-rendered ms", near.rerendered_ms),
                          median(near.face_ms).value, 6.0 * median(near.face_ms).value));
}

}  // namespace

Result<NearCosts> near_costs(house::Stage& stage, const methods::Settings& shipped, const NearViewWish& wish,
                             int views, int repeats) {
  std::vector<JudgedMethod> methods;
  for (const auto& [name, reflection] : {std::pair{"none", methods::Settings{"none"}},
                                         {"mem", shipped},
                                         {"rerendered", methods::Settings{"rerendered_cube_map", 128, false}},
                                         {"traced", methods::Settings{"traced"}}}) {
    Result<JudgedMethod> method = judged_method(stage, name, reflection);
    if (!method) return method.errors();
    methods.push_back(*std::move(method));
  }
  NearViews near_views(stage, width, height, wish);
  NearCosts near;
  for (int i = 0; i < views; ++i) {
    const Result<NearView> view = near_views.next();
    if (!view) return view.errors();
    const Result<std::vector<ReflectionCost>> costs =
        reflection_costs(stage, methods, view->camera, width, height, repeats, Frames::left_out);
    if (!costs) return costs.errors();
    near.mem_ms.push_back(median((*costs)[1].ms).value);
    near.rerendered_ms.push_back(median((*costs)[2].ms).value);
    near.traced_ms.push_back(median((*costs)[3].ms).value);
    near.seen.push_back(double(methods[2].reflections->faces_drawn()) / 6.0);
    near.face_ms.push_back(near.rerendered_ms.back() / std::max(methods[2].reflections->faces_drawn(), 1));
    const Result<double> flip = flip_over_none(stage, {methods[1], methods[0], methods[3]}, view->camera,
                                               width, height, view->window);
    if (!flip) return flip.errors();
    near.mem_flip_over_none.push_back(*flip);
  }
  return near;
}

Status measure_near_costs(house::Stage& stage, const methods::Settings& shipped, bool is_quick,
                          Report& report) {
  const int views = is_quick ? 3 : 8, repeats = is_quick ? 3 : 20;
  constexpr int cars_seen = 10;
  const Result<NearCosts> alone = near_costs(stage, shipped, {}, views, repeats),
                          among = near_costs(stage, shipped, {cars_seen, "", 1.0f}, views, repeats);
  if (!alone) return alone.errors();
  if (!among) return among.errors();
  note_costs("a near car", *alone, report);
  note_costs("a near car, ten seen", *among, report);
  const double rerendered = ratio_in_turn(among->rerendered_ms, among->mem_ms).value,
               one = ratio_in_turn(alone->rerendered_ms, alone->mem_ms).value;
  report.add("near_cost_ratio_rerendered_over_mem", rerendered, {min_rerendered, true});
  report.add_control("near_cost_ratio_rerendered_over_mem_one_car_of_the_ten",
                     rerendered / median(among->seen).value, {min_rerendered, true});
  report.add("near_cost_flip_mem_over_none", median(among->mem_flip_over_none).value, shows_reflections);
  report.note(fmt::format("in views of one car: {:.2f} times", one));
  report.add("traced_cost_over_mem_ten_seen", ratio_in_turn(among->traced_ms, among->mem_ms).value);
  report.add_control("traced_cost_over_mem_ten_re_rendered_in_its_place", rerendered, up_to(2.0));
  return Done{};
}

}  // namespace parvis::bench
