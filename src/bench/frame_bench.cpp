#include "bench/frame_bench.h"

#include <epoxy/gl.h>

#include <filesystem>

#include "base/random.h"
#include "base/test_data.h"
#include "bench/mirror_check.h"
#include "bench/scratch_folder.h"
#include "city/paper_city.h"
#include "render/culling_check.h"
#include "render/frustum.h"
#include "scene/city_json.h"
#include "stage/stage.h"

namespace parvis::bench {
namespace {
namespace fs = std::filesystem;

constexpr int width = 1280, height = 720;

Camera at(glm::vec3 eye, float heading_rad, float pitch_rad) {
  const glm::vec3 ahead(std::cos(heading_rad) * std::cos(pitch_rad),
                        std::sin(heading_rad) * std::cos(pitch_rad), std::sin(pitch_rad));
  Camera camera;
  camera.vertical_fov = vertical_fov(glm::radians(65.0f), float(width) / float(height));
  camera.world_from_camera = look_at(eye, eye + ahead);
  return camera;
}

/// Points on the lanes where traffic drives, from which a visitor or a driver looks, in an order that a seed
/// shuffles.
std::vector<Camera> viewpoints(const scene::Scene& scene, std::size_t count, float eye_height_m,
                               float pitch_rad) {
  Random random(5);
  std::vector<Camera> cameras;
  while (cameras.size() < count) {
    const scene::Lane& lane = scene.roads.lanes[std::size_t(random.index(int(scene.roads.lanes.size())))];
    const std::size_t i = std::size_t(random.index(int(lane.points.size()) - 1));
    const glm::vec3 along = lane.points[i + 1] - lane.points[i];
    const glm::vec3 eye = lane.points[i] + random.uniform() * along + glm::vec3(0, 0, eye_height_m);
    if (glm::distance(glm::vec2(eye), scene.traffic.centre) > scene.traffic.radius_m) continue;
    cameras.push_back(at(eye, std::atan2(along.y, along.x), pitch_rad));
  }
  return cameras;
}

stage::Play play_with(const scene::Scene& scene, int vehicles) {
  scene::Scene copy = scene;  // models are shared
  copy.traffic.vehicles = vehicles;
  return stage::make_play(std::move(copy));
}

int reflectors_seen(stage::Stage& stage, const Camera& camera) {
  stage.renderer().begin_frame(stage.scene(), camera);
  stage.renderer().prepare_main_view(camera, width, height);
  std::vector<render::Reflector> reflectors;
  render::find_reflectors(stage.renderer(), stage.scene(), camera, reflectors);
  return int(reflectors.size());
}

/// Vehicles in the frustum, hidden or not: a first sieve that draws nothing.
int vehicles_ahead(const scene::Scene& scene, const Camera& camera) {
  const render::Frustum frustum(render::camera_view(camera, 0, width, height).clip_from_world);
  int count = 0;
  for (const scene::Object& object : scene.objects) {
    const glm::vec3 position(object.world_from_model[3]);
    count += object.is_dynamic && frustum.may_see({position - 1.0f, position + 1.0f});
  }
  return count;
}

/// Lets traffic drive until some view, from a balcony or a roof, sees between `least` and `most` cars.
Result<Camera> view_of_cars(stage::Stage& stage, int least, int most, Report& report) {
  constexpr int longest_search_s = 120;
  for (int second = 0; second < longest_search_s; ++second) {
    for (const float height_m : {9.0f, 25.0f, 60.0f})
      for (const Camera& camera : viewpoints(stage.scene(), 24, height_m, -0.004f * height_m)) {
        if (vehicles_ahead(stage.scene(), camera) < least) continue;
        const int seen = reflectors_seen(stage, camera);
        if (seen < least || seen > most) continue;
        report.note(fmt::format("{} cars, {} seen, from {} m above a street, after {} s",
                                stage.play().traffic.vehicle_count(), seen, height_m, second));
        return camera;
      }
    stage.play().advance(1.0);
  }
  return error("no view of {} to {} cars was found within {} s of traffic", least, most, longest_search_s);
}

struct Method {
  const char* key;
  scene::Reflection reflection;
};

/// Times whole frames of each method in alternating order.
Status time_methods(stage::Stage& stage, const Camera& camera, int cars, int repeats, Report& report,
                    std::vector<Median>& medians) {
  using scene::ReflectionMethod;
  const Method methods[]{{"none", {ReflectionMethod::none, 128, false}},
                         {"rerendered", {ReflectionMethod::rerendered_cube_map, 128, false}},
                         {"rerendered_lod", {ReflectionMethod::rerendered_cube_map, 128, true}}};
  std::vector<double> samples[3];
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (int i = 0; i < 3; ++i) {
      const int method = (repeat % 2 == 0) ? i : 2 - i;
      if (Status status = stage.set_reflection(methods[method].reflection); !status) return status;
      stage.draw(camera, width, height);  // makes what is made once
      glFinish();
      samples[method].push_back(milliseconds([&] {
        stage.draw(camera, width, height);
        glFinish();
      }));
    }
  for (int i = 0; i < 3; ++i) {
    medians.push_back(median(samples[i]));
    report.add(fmt::format("frame_ms_{}_{}", methods[i].key, cars), medians.back());
  }
  return Done{};
}

/// Cars that are hidden by what stands before them: how many are culled, and whether one is that has a pixel.
void measure_occlusion(stage::Stage& stage, std::size_t views, Report& report) {
  render::CullingCheck all;
  for (const Camera& camera : viewpoints(stage.scene(), views, 1.6f, 0.0f)) {
    stage.renderer().begin_frame(stage.scene(), camera);
    const render::CullingCheck one =
        render::check_culling(stage.renderer(), stage.scene(), camera, width, height);
    all.hidden += one.hidden, all.hidden_culled += one.hidden_culled, all.false_culls += one.false_culls;
  }
  report.add("occlusion_culled_percent", all.hidden > 0 ? 100.0 * all.hidden_culled / all.hidden : 0.0);
  report.add("false_culls", all.false_culls);
  report.note(fmt::format("{} of {} hidden cars in the frustum are culled, over {} views", all.hidden_culled,
                          all.hidden, views));
}

void measure_reference(stage::Stage& stage, Report& report) {
  const Camera camera = viewpoints(stage.scene(), 1, 1.6f, 0.0f).front();
  const reference::TracedPicture traced = stage.trace(camera, 480, 270, 16);
  report.add("reference_mrays_s", 1e-6 * double(traced.rays) / traced.seconds);
}

void measure_denhaag(Report& report) {
  const auto file = shared_data("cities/DenHaag_01.city.json", fs::current_path());
  if (!file) return report.skip("load_ms_denhaag", "the shared data is absent");
  std::vector<double> samples(5);
  for (double& sample : samples)
    sample = milliseconds([&] {
      Errors warnings;
      static_cast<void>(scene::read_city_model(*file, warnings));
    });
  report.add("load_ms_denhaag", median(samples));
}

}  // namespace

Result<Report> frame_bench(bool is_quick) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  Report report("frame");
  report.note("machine: " + gl::driver_name());
  const ScratchFolder folder;
  Status written = Done{};
  const double generated_ms = milliseconds([&] { written = city::write_paper_city(folder.path, 1); });
  if (!written) return written.errors();
  const Result<scene::LoadedScene> loaded =
      scene::load_scene(folder.path / "paper.xp", stage::node_registry());
  if (!loaded) return loaded.errors();
  report.add("triangles", double(loaded->scene.static_triangle_count()));
  report.add("city_generate_ms", generated_ms);

  const int repeats = is_quick ? 7 : 21;
  for (const auto& [cars, least, most] : {std::tuple{15, 3, 5}, std::tuple{30, 10, 10}}) {
    Result<std::unique_ptr<stage::Stage>> stage = stage::Stage::create(play_with(loaded->scene, cars));
    if (!stage) return stage.errors();
    const Result<Camera> camera = view_of_cars(**stage, least, most, report);
    if (!camera) return camera.errors();
    const int seen = reflectors_seen(**stage, *camera);
    std::vector<Median> medians;
    if (Status status = time_methods(**stage, *camera, cars, repeats, report, medians); !status)
      return status.errors();
    if (cars < 30) continue;
    report.add("rerendered_ms_per_car", (medians[1].value - medians[0].value) / std::max(seen, 1));
    measure_occlusion(**stage, is_quick ? 80 : 400, report);
    measure_reference(**stage, report);
  }
  measure_denhaag(report);
  const Result<MirrorFlips> flips = mirror_flips();
  if (!flips) return flips.errors();
  report.add("ball_flip", flips->ball);
  report.add("box_flip", flips->box);
  report.add("ball_flip_faces_swapped", flips->ball_faces_swapped);
  report.note(fmt::format(
      "surroundings at 2000 radii; at 50 radii, where the map's one centre shows: ball {:.4f}, box {:.4f}",
      flips->ball_at_50_radii, flips->box_at_50_radii));
  return report;
}

}  // namespace parvis::bench
