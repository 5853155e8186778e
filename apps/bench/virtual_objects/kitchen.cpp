#include "bench/virtual_objects/kitchen.h"

#include <algorithm>
#include <array>

#include "bench/scratch_folder.h"
#include "bench/virtual_objects/beside_rerendered.h"
#include "bench/virtual_objects/frames.h"
#include "bench/virtual_objects/reflected_points.h"
#include "bench/virtual_objects/search.h"
#include "graphics/gl/context.h"
#include "places/kitchen/kitchen.h"
#include "reflections/reflector_maps/reflector_cache.h"

namespace parvis::bench {
namespace {

constexpr std::array cameras{"at the kettle", "into the bowl", "figure 6", "at the pans", "at the spoons"};
// Of convex mirrors, and of a concave one, which is drawn in many layers, each as slow as a picture.
constexpr std::size_t quick_cameras = 2;
constexpr std::size_t views_that_may_miss = 1;
constexpr double max_flip_ratio = 0.2, max_p99_px = 1.0;
constexpr int width = 960, height = 600, quick_width = 480, quick_height = 300;
constexpr std::size_t points = 4000, quick_points = 400;  // a camera

MapSearch::PatchPoint by_shipped_search(MapSearch& search, const MapSearch::ReflectionTask& task, int layer) {
  return search.search_patch(task, search.patch_kind(), layer);
}

/// The control: the paper's search finds one point, whatever the layer.
MapSearch::PatchPoint by_paper_search(MapSearch& search, const MapSearch::ReflectionTask& task, int) {
  return by_midpoint(search, task);
}

/// What all views reach but those that may miss it.
double reached_px(std::vector<double> p99_of_views) {
  std::ranges::sort(p99_of_views);
  return p99_of_views[p99_of_views.size() - 1 - views_that_may_miss];
}

/// `kitchen_p99_px`: the 99th percentile of a view's pixels, extra and missed points among them, that four of
/// the five views reach.
Status measure_points(const house::Stage& stage, const BenchSetup& setup, Report& report) {
  const Result<ReflectedPoints> reflected = ReflectedPoints::make(stage.scene());
  if (!reflected) return reflected.errors();
  std::vector<double> p99_of_views, p99_of_control;
  for (const char* name : cameras) {
    const Result<Camera> camera = stage.camera(name);
    if (!camera) return camera.errors();
    const std::size_t count = setup.is_quick ? quick_points : points;
    const ReflectedPointErrors errors = reflected->errors(*camera, width, height, count, by_shipped_search),
                               of_paper = reflected->errors(*camera, width, height, count, by_paper_search);
    if (errors.px.empty()) return error("the camera \"{}\" shows no mirror", name);
    report.note(fmt::format(
        "{}: of {} points that its mirrors show, {} are missed and {} shown once more; median, 95 %, 99 % "
        "{:.3f} {:.3f} {:.2f} px",
        name, errors.px.size() - errors.extra, errors.missed, errors.extra, percentile(errors.px, 0.5),
        percentile(errors.px, 0.95), percentile(errors.px, 0.99)));
    p99_of_views.push_back(percentile(errors.px, 0.99));
    p99_of_control.push_back(percentile(of_paper.px, 0.99));
  }
  report.add("kitchen_p99_px", reached_px(std::move(p99_of_views)), up_to(max_p99_px));
  report.add_control("kitchen_p99_px_of_nine_midpoint_steps", reached_px(std::move(p99_of_control)),
                     up_to(max_p99_px));
  return Done{};
}

}  // namespace

Result<std::unique_ptr<house::Stage>> open_kitchen(const House& house, const std::filesystem::path& folder,
                                                   const std::string& script) {
  if (Status status = kitchen::write_kitchen(folder, 1); !status) return status.errors();
  Result<house::Play> play = house::open_play(house, folder / script, {});
  if (!play) return play.errors();
  // Once for all: the points, the stage and the method that is judged each need them.
  if (const auto baked = reflector_maps::bake_reflectors(play->scene); !baked) return baked.errors();
  return house::Stage::create(*std::move(play));
}

Status measure_kitchen(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  const ScratchFolder folder;
  Result<std::unique_ptr<house::Stage>> stage = open_kitchen(setup.house, folder.path, "kitchen.xp");
  if (!stage) return stage.errors();
  if (Status status = measure_points(**stage, setup, report); !status) return status;
  if (Status status = measure_beside_rerendered(
          **stage, std::span(cameras).first(setup.is_quick ? quick_cameras : cameras.size()),
          setup.is_quick ? quick_width : width, setup.is_quick ? quick_height : height,
          "kitchen_flip_over_rerendered", max_flip_ratio, report);
      !status)
    return status;
  return setup.is_quick ? Status(Done{}) : measure_frames(**stage, report);  // minutes
}

}  // namespace parvis::bench
