#include "bench/vegetation/vegetation_bench.h"

#include <algorithm>
#include <ctime>
#include <glm/gtc/matrix_transform.hpp>

#include "bench/flip_between.h"
#include "bench/vegetation/grove.h"
#include "bench/vegetation/pop_bench.h"

namespace parvis::bench {
namespace {

using vegetation::PlantDetail;

constexpr float closer = 0.4f;  // of a view's angle
constexpr Target of_fps = {10.0, true}, of_flip = {0.05, false}, of_primitives = {300'000.0, false};
/// More than there are: what a view would draw without a budget.
constexpr int no_budget = 2'000'000'000;

/// Under the first trees, from the lawn before all of them, and from above.
std::vector<Camera> grove_views() {
  std::vector<Camera> cameras(3);
  cameras[0].world_from_camera = look_at({5.0f, 5.0f, 1.7f}, {0.0f, 60.0f, 4.0f});
  cameras[1].world_from_camera = look_at({0.0f, -60.0f, 1.7f}, {0.0f, 60.0f, 5.0f});
  cameras[2].world_from_camera = look_at({-60.0f, -40.0f, 25.0f}, {0.0f, 50.0f, 3.0f});
  for (Camera& camera : cameras) camera.vertical_fov = 0.8f;
  return cameras;
}

/// Frames while the viewer walks on.
struct FrameTimes {
  std::vector<double> ms;  ///< of each frame
  double cpu_ms = 0.0;     ///< of all cores, per frame
};

/// With `is_day_passing` the sun moves from frame to frame, and each draws its shadow maps again; else they
/// are kept, but for what the viewer's way asks for.
Result<FrameTimes> frame_times(Grove& grove, Camera camera, int frames, bool is_day_passing) {
  const int to_begin = is_day_passing ? 1 : 2;  // draw what is kept
  FrameTimes times;
  std::clock_t before = 0;
  for (int i = 0; i < frames + to_begin; ++i) {
    camera.world_from_camera =
        glm::translate(glm::mat4(1.0f), {0.02f, 0.02f, 0.0f}) * camera.world_from_camera;
    if (is_day_passing) grove.turn_sun(minute_of_sun_deg);
    if (i == to_begin) before = std::clock();
    Status status = Done{};
    const double ms = milliseconds([&] {
      status = grove.draw(camera);
      glFinish();
    });
    if (!status) return status.errors();
    if (i >= to_begin) times.ms.push_back(ms);
  }
  times.cpu_ms = 1e3 * double(std::clock() - before) / CLOCKS_PER_SEC / double(frames);
  return times;
}

/// What the views of the grove cost: the slowest frames, the largest counts.
struct Cost {
  std::vector<double> slowest_ms, slowest_kept_ms;
  double in_view = 0.0, in_frame = 0.0;                 ///< primitives; of shadow views, too
  double without_budget = 0.0, of_real_geometry = 0.0;  ///< in a main view
  double min_scale = 1.0;                               ///< by which a budget was kept

  Status add(Grove& grove, const Camera& camera, int frames, const std::string& name, Report& report) {
    const auto passing = frame_times(grove, camera, frames, true),
               kept = frame_times(grove, camera, frames, false);
    if (!passing) return passing.errors();
    if (!kept) return kept.errors();
    const auto keep_slower = [](std::vector<double>& slowest, const std::vector<double>& ms) {
      if (slowest.empty() || median(ms).value > median(slowest).value) slowest = ms;
    };
    keep_slower(slowest_ms, passing->ms), keep_slower(slowest_kept_ms, kept->ms);
    report.note(fmt::format(
        "{}: {:.0f} ms per frame under a sun that moves, {:.0f} ms of all cores; with shadow maps "
        "that are kept {:.0f}, {:.0f}",
        name, median(passing->ms).value, passing->cpu_ms, median(kept->ms).value, kept->cpu_ms));
    return count(grove, camera, name, report);
  }

 private:
  Status count(Grove& grove, const Camera& camera, const std::string& name, Report& report) {
    const auto views = grove.counted(camera);
    if (!views) return views.errors();
    double all = 0.0;
    long main_views = 0, shadow_views = 0;
    for (const CountedPlants::View& view : *views) {
      const bool is_shadow = view.kind == render::ViewKind::shadow;
      ++(is_shadow ? shadow_views : main_views);
      all += double(view.drawn);
      in_view = std::max(in_view, double(view.drawn));
      min_scale = std::min(min_scale, double(view.scale));
      report.note(fmt::format(
          "{}, {}: {} triangles, {} points, {} lines{}", name, is_shadow ? "a shadow map" : "the view itself",
          view.chosen.triangles, view.chosen.points, view.chosen.lines,
          view.scale < 1.0f ? fmt::format(", kept to the budget by {:.2f} of the resolution", view.scale)
                            : std::string(", below the budget by themselves")));
    }
    if (main_views != 1 || shadow_views == 0)
      return error("{}: a frame under a new sun has drawn {} main and {} shadow views", name, main_views,
                   shadow_views);
    in_frame = std::max(in_frame, all);
    PlantDetail unlimited;
    unlimited.max_primitives = no_budget;
    without_budget = std::max(without_budget, double(grove.chosen(camera, unlimited).chosen.all()));
    of_real_geometry =
        std::max(of_real_geometry, double(grove.chosen(camera, {.is_full = true}).chosen.all()));
    return Done{};
  }
};

/// Pictures of the grove against its real geometry.
struct Quality {
  double flip = 0.0, flip_thin = 0.0;  ///< the largest; area not kept
  double flip_full = 0.0;              ///< of the real geometry at the samples that pictures have
  double flip_bare = 1e9;              ///< the smallest of a lawn without trees
  std::vector<double> full_ms;         ///< what the real geometry took

  /// Of so many rows of trees, in the forms that the view has of all of them.
  Status add(Grove& grove, const Camera& camera, int rows, const std::string& name, Report& report) {
    const float scale_of_all = grove.chosen(camera, {}).scale;
    grove.show_rows(rows);
    const PlantDetail as_shipped = rows < Grove::rows ? grove.detail_at(camera, scale_of_all) : PlantDetail();
    PlantDetail without_area = as_shipped;
    without_area.keeps_area = false;
    const Result<Image8> truth = grove.true_picture(camera);
    if (!truth) return truth.errors();
    const auto flip_of = [&](const Result<Image8>& picture) { return flip_between(picture, *truth); };
    Result<Image8> real_geometry = Image8();
    full_ms.push_back(milliseconds([&] { real_geometry = grove.picture(camera, {.is_full = true}); }));
    const Result<double> full = flip_of(real_geometry), shipped = flip_of(grove.picture(camera, as_shipped)),
                         thin = flip_of(grove.picture(camera, without_area));
    grove.show_rows(0);
    const Result<double> bare = flip_of(grove.picture(camera));
    grove.show_rows(Grove::rows);
    for (const auto* each : {&full, &shipped, &thin, &bare})
      if (!*each) return each->errors();
    flip = std::max(flip, *shipped), flip_thin = std::max(flip_thin, *thin);
    flip_full = std::max(flip_full, *full), flip_bare = std::min(flip_bare, *bare);
    report.note(fmt::format("{}: FLIP {:.4f}, area not kept {:.4f}; real geometry: {:.4f}, in {:.1f} s", name,
                            *shipped, *thin, *full, full_ms.back() / 1e3));
    return Done{};
  }
};

void report_cost(const Cost& cost, const Quality& quality, std::size_t views, Report& report) {
  const Median frame = median(cost.slowest_ms);
  report.add("vegetation_fps_200_trees_1m_triangles", 1e3 / frame.value, of_fps);
  report.add("vegetation_fps_while_shadow_maps_are_kept", 1e3 / median(cost.slowest_kept_ms).value, of_fps);
  report.add_control("vegetation_fps_real_geometry_control", 1e3 / median(quality.full_ms).value, of_fps);
  report.note(fmt::format(
      "slowest of {} views, {} x {} pixels, a walking viewer and a sun that moves, so that every frame draws "
      "its shadow maps again; 95 % interval {:.1f} to {:.1f} fps",
      views, Grove::width, Grove::height, 1e3 / frame.high, 1e3 / frame.low));
  report.note(
      "vegetation_fps_real_geometry_control: one picture of the trees that are compared, its shadow maps "
      "included");
  report.add("vegetation_primitives", cost.in_view, of_primitives);
  report.add_control("vegetation_primitives_real_geometry_control", cost.of_real_geometry, of_primitives);
  report.add("vegetation_primitives_of_a_frame_with_its_shadow_maps", cost.in_frame);
  report.add("vegetation_primitives_without_a_budget", cost.without_budget);
  report.add("vegetation_budget_scale", cost.min_scale);
  report.note(
      "vegetation_primitives: as OpenGL counts them in any one view, those of shadow maps among them. A "
      "budget keeps each of them "
      "below its limit, by as much of the resolution as vegetation_budget_scale says in the worst of them; "
      "without it a main view would draw vegetation_primitives_without_a_budget");
}

void report_quality(const Quality& quality, Report& report) {
  report.add("vegetation_flip", quality.flip, of_flip);
  report.add_control("vegetation_flip_area_not_kept_control", quality.flip_thin, of_flip);
  report.add("vegetation_flip_of_real_geometry", quality.flip_full);
  report.add_control("vegetation_flip_without_trees_control", quality.flip_bare, of_flip);
  report.note(
      fmt::format("vegetation_flip: against the real geometry with {0} x {0} times the samples of a picture; "
                  "vegetation_flip_of_real_geometry: with those of a picture",
                  Grove::supersample));
}

}  // namespace

/// A grove of 200 oaks of a million triangles each. Quality and cost are measured in the same views, and
/// closer, where trees fill the picture.
Status measure_vegetation(const BenchSetup& setup, Report& report) {
  auto made = Grove::create(setup, report);
  if (!made) return made.errors();
  Grove& grove = **made;

  constexpr int quick_rows = 2;
  const std::vector<Camera> views = grove_views();
  Cost cost;
  Quality quality;
  std::size_t measured = 0;
  for (std::size_t v = 0; v < views.size(); ++v)
    for (const float share_of_angle : {1.0f, closer}) {
      Camera camera = views[v];
      camera.vertical_fov *= share_of_angle;
      const bool is_left_out = setup.is_quick && (v == 2 || (v == 0 && share_of_angle == closer));
      if (is_left_out) continue;
      ++measured;
      const std::string name = fmt::format("view {} at {} of its angle", v, share_of_angle);
      if (Status status = cost.add(grove, camera, setup.is_quick ? 5 : 15, name, report); !status)
        return status;
      if (Status status = quality.add(grove, camera, setup.is_quick ? quick_rows : Grove::rows, name, report);
          !status)
        return status;
    }
  report_cost(cost, quality, measured, report);
  if (setup.is_quick)
    report.note(
        "FLIP is of the 40 trees nearest to the lawn, in the forms that the view has of all 200, cost of all "
        "200 in the same views; without --quick both are of 200 trees, in twice as many views");
  if (!(quality.flip_bare > of_flip.limit))
    return error("a lawn without trees has a FLIP of {}: the trees are not drawn", quality.flip_bare);
  report_quality(quality, report);
  return measure_pops(setup, grove, report);
}

void add_vegetation(Benches& benches) {
  benches.add({"vegetation", "points and lines of grown plants against their real geometry",
               in_context(measure_vegetation)});
}

}  // namespace parvis::bench
