#include "reflections/environment_rays/bench/multiple_environment_maps_bench.h"

#include <cmath>
#include <numeric>

#include "base/progress.h"
#include "bench/benches.h"
#include "bench/reflection_cost.h"
#include "bench/scratch_folder.h"
#include "bench/street_views.h"
#include "graphics/gl/context.h"
#include "places/paper_city/paper_city.h"
#include "reflections/environment_rays/bench/cost_scaling.h"
#include "reflections/environment_rays/bench/frame_budget.h"
#include "reflections/environment_rays/bench/map_figures.h"
#include "reflections/environment_rays/bench/motion_error.h"
#include "reflections/environment_rays/bench/near_views.h"
#include "reflections/environment_rays/bench/view_error.h"
#include "reflections/methods/settings.h"
#include "reflections/probes/methods.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 720;

/// The configuration that every key speaks of.
methods::Settings shipped() {
  methods::Settings reflection;
  reflection.method = "multiple_environment_maps";
  return reflection;
}

methods::Settings usual(const char* method, bool uses_level_of_detail = false) {
  return {method, 128, uses_level_of_detail};
}

/// Makes methods for a stage.
Result<std::vector<JudgedMethod>> make(house::Stage& stage,
                                       const std::vector<std::pair<const char*, methods::Settings>>& wanted) {
  std::vector<JudgedMethod> methods;
  for (const auto& [name, reflection] : wanted) {
    Result<JudgedMethod> method = judged_method(stage, name, reflection);
    if (!method) return method.errors();
    methods.push_back(*std::move(method));
  }
  return methods;
}

double mean_flip(const std::vector<ViewFlips>& views, std::size_t method) {
  return std::accumulate(views.begin(), views.end(), 0.0,
                         [&](double sum, const ViewFlips& view) { return sum + view.of_method[method]; }) /
         double(std::max(views.size(), std::size_t{1}));
}

std::vector<ViewFlips> those_at(const std::vector<ViewFlips>& views, bool is_at_crossing) {
  std::vector<ViewFlips> some;
  std::ranges::copy_if(views, std::back_inserter(some),
                       [&](const ViewFlips& view) { return view.is_at_crossing == is_at_crossing; });
  return some;
}

Status measure_quality(house::Stage& stage, const BenchSetup& setup, Report& report) {
  const Result<std::vector<JudgedMethod>> methods = make(stage, {{"mem", shipped()},
                                                                 {"none", usual("none")},
                                                                 {"rerendered", usual("rerendered_cube_map")},
                                                                 {"box", usual("box_projected_probe")},
                                                                 {"simple_blend", usual("simple_blend")},
                                                                 {"local", usual("local_environment_maps")},
                                                                 {"traced", usual("traced")}});
  if (!methods) return methods.errors();
  const Result<std::vector<ViewFlips>> views =
      setup.is_quick ? flips_of_methods(stage, *methods, 8, width / 2, height / 2)
                     : flips_of_methods(stage, *methods, 20, width, height);
  if (!views) return views.errors();
  for (std::size_t m = 0; m < methods->size(); ++m) {
    std::string row = fmt::format("FLIP {}: mean {:.4f}, views", (*methods)[m].name, mean_flip(*views, m));
    for (const ViewFlips& view : *views) row += fmt::format(" {:.3f}", view.of_method[m]);
    report.note(row);
  }
  const double mem = mean_flip(*views, 0);
  double worst = 0.0;
  for (const ViewFlips& view : *views) worst = std::max(worst, view.of_method[0] / view.of_method[2]);
  report.add("flip_ratio_mem_over_rerendered", mem / mean_flip(*views, 2));
  report.add("flip_ratio_mem_over_rerendered_worst", worst);
  report.add("local_flip_ratio", mean_flip(*views, 5) / mean_flip(*views, 2));
  constexpr double max_traced_flip = 0.02;
  report.add("traced_flip", mean_flip(*views, 6), up_to(max_traced_flip));
  report.note(fmt::format("control, no reflections at all: FLIP {:.4f}, which must exceed {}: {}",
                          mean_flip(*views, 1), max_traced_flip,
                          mean_flip(*views, 1) > max_traced_flip ? "it does" : "IT DOES NOT"));
  report.add("flip_ratio_mem_over_simple_blend", mem / mean_flip(*views, 4));
  for (const bool is_at_crossing : {false, true}) {
    const std::vector<ViewFlips> some = those_at(*views, is_at_crossing);
    report.note(fmt::format("{} views {}", some.size(), is_at_crossing ? "at crossings" : "in streets"));
    report.add(is_at_crossing ? "flip_ratio_mem_over_box_crossing" : "flip_ratio_mem_over_box_street",
               mean_flip(some, 0) / mean_flip(some, 3));
  }
  return Done{};
}

/// What near views cost, those that FLIP is judged in: milliseconds of each view.
struct NearCosts {
  std::vector<double> mem_ms, traced_ms, rerendered_ms, face_ms;
};

Result<NearCosts> near_costs(house::Stage& stage, int views, int repeats) {
  const Result<std::vector<JudgedMethod>> methods = make(stage, {{"none", usual("none")},
                                                                 {"mem", shipped()},
                                                                 {"rerendered", usual("rerendered_cube_map")},
                                                                 {"traced", usual("traced")}});
  if (!methods) return methods.errors();
  NearViews near_views(stage, width, height);
  NearCosts near;
  for (int i = 0; i < views; ++i) {
    const Result<NearView> view = near_views.next();
    if (!view) return view.errors();
    const Result<std::vector<ReflectionCost>> costs =
        reflection_costs(stage, *methods, view->camera, width, height, repeats, Frames::left_out);
    if (!costs) return costs.errors();
    near.mem_ms.push_back(median((*costs)[1].ms).value);
    near.rerendered_ms.push_back(median((*costs)[2].ms).value);
    near.traced_ms.push_back(median((*costs)[3].ms).value);
    near.face_ms.push_back(near.rerendered_ms.back() / std::max((*methods)[2].reflections->faces_drawn(), 1));
  }
  return near;
}

/// `near_cost_ratio_rerendered_over_mem` and `traced_cost_over_mem`.
void report_near_costs(const NearCosts& near, Report& report) {
  constexpr double min_rerendered = 10.0, max_traced = 2.0;
  const Median rerendered = ratio_in_turn(near.rerendered_ms, near.mem_ms);
  report.add("near_cost_ratio_rerendered_over_mem", rerendered.value, {min_rerendered, true});
  report.add("traced_cost_over_mem", ratio_in_turn(near.traced_ms, near.mem_ms).value, up_to(max_traced));
  report.note(fmt::format(
      "control of both: re-rendered maps in place of rays, {:.2f} times mem, must exceed {}; "
      "rays in place of re-rendered maps, {:.2f} times mem, must be less than {}",
      rerendered.value, max_traced, ratio_in_turn(near.traced_ms, near.mem_ms).value, min_rerendered));
}

/// Faces of cube maps that could be drawn in the time that the shipped method takes in near views; one at
/// least.
Result<int> faces_for_the_same_time(house::Stage& stage, int repeats, Report& report) {
  constexpr int views = 3;
  const Result<NearCosts> near = near_costs(stage, views, repeats);
  if (!near) return near.errors();
  report_near_costs(*near, report);
  const double mem_ms = median(near->mem_ms).value, face_ms = median(near->face_ms).value;
  const int faces = std::max(int(std::lround(mem_ms / face_ms)), 1);
  report.note(
      fmt::format("near views: mem {:.2f} ms, traced {:.2f} ms, a re-rendered face {:.2f} ms: {} time-sliced "
                  "faces a frame",
                  mem_ms, median(near->traced_ms).value, face_ms, faces));
  return faces;
}

Status measure_motion(house::Stage& stage, const BenchSetup& setup, Report& report) {
  methods::Settings sliced = usual("time_sliced_cube_map");
  const Result<int> faces = faces_for_the_same_time(stage, setup.is_quick ? 3 : 20, report);
  if (!faces) return faces.errors();
  sliced.own.get<probes::TimeSlicing>().faces_per_frame = *faces;
  const Result<std::vector<JudgedMethod>> methods = make(
      stage, {{"mem", shipped()}, {"rerendered", usual("rerendered_cube_map")}, {"time_sliced", sliced}});
  if (!methods) return methods.errors();
  const Result<MotionErrors> errors = setup.is_quick
                                          ? errors_in_motion(stage, *methods, 2, width / 2, height / 2)
                                          : errors_in_motion(stage, *methods, 20, width, height);
  if (!errors) return errors.errors();
  report.note(fmt::format("{} drives beside cars: true frames differ by {:.4f} inside reflections",
                          errors->drives, errors->true_difference));
  for (std::size_t m = 0; m < methods->size(); ++m)
    report.note(fmt::format("driving, {}: FLIP {:.4f}, error of frame differences {:.4f}", (*methods)[m].name,
                            errors->flip[m], errors->difference[m]));
  report.add("flip_ratio_mem_over_time_sliced", errors->flip[0] / errors->flip[2]);
  report.add("motion_error_ratio_mem_over_rerendered", errors->difference[0] / errors->difference[1]);
  return Done{};
}

/// Times methods beside one without reflections, and reports the cost of each.
Result<std::vector<ReflectionCost>> reported_costs(
    house::Stage& stage, const Camera& camera, int repeats, Frames frames,
    const std::vector<std::pair<const char*, methods::Settings>>& wanted, Report& report) {
  const Result<std::vector<JudgedMethod>> methods = make(stage, wanted);
  if (!methods) return methods.errors();
  Result<std::vector<ReflectionCost>> costs =
      reflection_costs(stage, *methods, camera, width, height, repeats, frames);
  if (!costs) return costs.errors();
  for (std::size_t m = 0; m < methods->size(); ++m) {
    const Median ms = median((*costs)[m].ms);
    std::string row = fmt::format("{}: reflections {:.2f} ms ({:.2f} to {:.2f})", (*methods)[m].name,
                                  ms.value, ms.low, ms.high);
    if (frames == Frames::whole) row += fmt::format(", frame {:.1f} ms", median((*costs)[m].frame_ms).value);
    report.note(row);
  }
  return costs;
}

Status measure_cost(const BenchSetup& setup, const scene::Scene& city, Report& report) {
  constexpr int cars_seen = 30;
  Result<std::unique_ptr<house::Stage>> stage = house::Stage::create(play_with(setup.house, city, 120));
  if (!stage) return stage.errors();
  const Result<Camera> camera = view_of_cars(**stage, cars_seen, cars_seen, width, height, report);
  if (!camera) return camera.errors();
  // What costs least differs least from none, and needs most samples.
  const Result<std::vector<ReflectionCost>> cheap = reported_costs(
      **stage, *camera, setup.is_quick ? 20 : 60, Frames::whole,
      {{"none", usual("none")}, {"mem", usual("multiple_environment_maps")}, {"mem_lod", shipped()}}, report);
  if (!cheap) return cheap.errors();
  const Result<std::vector<ReflectionCost>> rerendered_costs =
      reported_costs(**stage, *camera, setup.is_quick ? 5 : 30, Frames::left_out,
                     {{"none", usual("none")},
                      {"rerendered", usual("rerendered_cube_map")},
                      {"rerendered_lod", usual("rerendered_cube_map", true)},
                      {"local", usual("local_environment_maps")}},
                     report);
  if (!rerendered_costs) return rerendered_costs.errors();
  const Median mem = median((*cheap)[1].ms), mem_lod = median((*cheap)[2].ms),
               rerendered = median((*rerendered_costs)[1].ms);
  report.add("cost_ratio_rerendered_over_mem_30", ratio(rerendered, mem));
  report.add("cost_ratio_rerendered_over_mem_lod_30", ratio(median((*rerendered_costs)[2].ms), mem_lod));
  report.add("local_cost_ratio_30", ratio(rerendered, median((*rerendered_costs)[3].ms)));
  report.add("frame_ratio_mem_over_none_30", ratio_in_turn((*cheap)[2].frame_ms, (*cheap)[0].frame_ms));
  return Done{};
}

Status measure(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  const ScratchFolder folder;
  if (Status written = city::write_paper_city(folder.path, 1); !written) return written.errors();
  const Result<scene::LoadedScene> city =
      scene::load_scene(folder.path / "paper.xp", setup.house.get<scene::NodeRegistry>());
  if (!city) return city.errors();
  Result<std::unique_ptr<house::Stage>> stage =
      house::Stage::create(house::make_play(setup.house, city->scene));
  if (!stage) return stage.errors();
  const int repeats = setup.is_quick ? 7 : 30;
  const std::function<Status()> parts[]{
      [&]() -> Status {
        measure_memory(shipped().resolution, report);
        measure_rays(city->scene, report);
        return Done{};
      },
      [&]() -> Status {
        measure_placement(city->scene, report);
        return Done{};
      },
      [&] { return keep_maps(setup.house, city->scene, shipped()); },
      [&] { return measure_cost(setup, city->scene, report); },
      [&] { return measure_body_count(setup.house, city->scene, shipped(), repeats, report); },
      [&] { return measure_city_size(setup.house, city->scene, shipped(), repeats, report); },
      [&] { return measure_quality(**stage, setup, report); },
      [&] { return measure_motion(**stage, setup, report); },
      [&] {
        return setup.is_quick ? measure_budget(**stage, shipped(), 6, width / 2, height / 2, report)
                              : measure_budget(**stage, shipped(), 60, width, height, report);
      }};
  Progress progress("parts of the bench", std::size(parts));
  for (const std::function<Status()>& part : parts) {
    if (Status status = part(); !status) return status.errors();
    progress.advance();
  }
  return Done{};
}

}  // namespace

void furnish_multiple_environment_maps(House& house) {
  house.get<Benches>().add({"multiple_environment_maps",
                            "their cost and their error against the ray tracer, beside the baselines",
                            measure});
}

}  // namespace parvis::bench
