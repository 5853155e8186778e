#include "life/vegetation/bench/vegetation_bench.h"

#include <algorithm>
#include <ctime>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "base/random.h"
#include "base/reduction.h"
#include "bench/benches.h"
#include "graphics/gl/context.h"
#include "graphics/reference/metrics.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/light_source.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/tone_curve.h"
#include "life/vegetation/plant_drawable.h"
#include "life/vegetation/plant_selection.h"
#include "life/vegetation/scene_plant.h"
#include "places/paper_city/round_mesh.h"

namespace parvis::bench {
namespace {

using vegetation::PlantDetail, vegetation::PlantSelection, vegetation::PlantStatistics;

constexpr int width = 640, height = 360;
constexpr int supersample = 4;  // of the truth, across and down
constexpr int rows = 10, columns = 20, shapes = 4;
constexpr float spacing_m = 11.0f;
constexpr float closer = 0.4f;  // of a view's angle

/// 200 oaks of four shapes on a lawn.
Result<scene::Scene> make_grove(Report& report) {
  scene::Scene scene;
  auto lawn = std::make_shared<scene::Model>();
  scene::Part part;
  part.mesh = city::panelled_box({-300, -300, -1}, {300, 300, 0}, 20.0f);
  lawn->parts.push_back(std::move(part));
  lawn->materials.emplace_back();
  lawn->materials.back().base_colour = {0.12f, 0.2f, 0.06f};
  scene::Object object;
  object.name = "lawn", object.model = std::move(lawn);
  scene.objects.push_back(std::move(object));
  const vegetation::PlantKind* oak = vegetation::find_kind("oak");
  Random random(12);
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (int i = 0; i < rows * columns; ++i) {
    auto shape = vegetation::shared_plant(scene.data<vegetation::PlantShelf>(),
                                          {oak, oak->height_m, 0.0f, std::uint64_t(1 + i % shapes)});
    if (!shape) return shape.errors();
    fewest = std::min(fewest, (*shape)->triangle_count());
    const int row = i / columns;
    const glm::vec3 foot(spacing_m * (float(i % columns) - 9.5f) + random.uniform(-2.0f, 2.0f),
                         spacing_m * float(row + 1) + random.uniform(-2.0f, 2.0f), 0.0f);
    const glm::mat4 world_from_plant =
        glm::rotate(glm::translate(glm::mat4(1.0f), foot), random.uniform(0.0f, 6.28f), glm::vec3(0, 0, 1));
    scene.data<vegetation::ScenePlants>().add({*shape, world_from_plant, true}, i);
  }
  report.note(fmt::format("{} oaks of {} triangles at least, {} shapes", rows * columns, fewest, shapes));
  if (fewest < 1'000'000) return error("the oaks have {} triangles, not a million", fewest);
  return scene;
}

/// Under the first trees, from the lawn before all of them, and from above.
std::vector<Camera> grove_views() {
  std::vector<Camera> cameras(3);
  cameras[0].world_from_camera = look_at({5.0f, 5.0f, 1.7f}, {0.0f, 60.0f, 4.0f});
  cameras[1].world_from_camera = look_at({0.0f, -60.0f, 1.7f}, {0.0f, 60.0f, 5.0f});
  cameras[2].world_from_camera = look_at({-60.0f, -40.0f, 25.0f}, {0.0f, 50.0f, 3.0f});
  for (Camera& camera : cameras) camera.vertical_fov = 0.8f;
  return cameras;
}

PlantStatistics counted(const scene::Scene& scene, const Camera& camera, const PlantDetail& detail) {
  const render::View view = render::camera_view(camera, 0, width, height);
  std::vector<vegetation::PlacedPlant> plants;
  for (const vegetation::ScenePlant& plant : vegetation::scene_plants(scene))
    plants.push_back(vegetation::placed(plant, int(scene.objects.size() + plants.size())));
  PlantSelection selection;
  selection.choose(plants, view, render::Culling(view, nullptr), detail);
  return selection.statistics();
}

/// Shows the rows of trees that are nearest to the lawn: the real geometry of all takes minutes.
void show_rows(int shown, scene::Scene& scene) {
  int number = 0;
  for (vegetation::ScenePlant& plant : scene.data<vegetation::ScenePlants>().items)
    plant.is_visible = number++ < shown * columns;
}

/// Draws plants in some detail with `scale` times the pixels of a picture, across and down.
Status draw(render::Renderer& renderer, scene::Scene& scene, const Camera& camera, const PlantDetail& detail,
            int scale) {
  scene.data<PlantDetail>() = detail;
  Status status = render::draw_frame(renderer, scene, {camera, scale * width, scale * height});
  scene.data<PlantDetail>() = {};
  return status;
}

Result<Image8> drawn(render::Renderer& renderer, scene::Scene& scene, const Camera& camera,
                     const PlantDetail& detail) {
  if (const Status status = draw(renderer, scene, camera, detail, 1); !status) return status.errors();
  return renderer.read_picture(scene.exposure);
}

/// The real geometry, whose pixels are the mean of many samples: leaves are smaller than pixels, and the few
/// samples that a picture has of each show which of them they hit, not what a crown looks like.
Result<Image8> drawn_finely(render::Renderer& renderer, scene::Scene& scene, const Camera& camera) {
  if (const Status status = draw(renderer, scene, camera, {.is_full = true}, supersample); !status)
    return status.errors();
  return shading::tone_mapped_picture(reduced(renderer.read_radiance(), supersample), scene.exposure);
}

/// Frames while the viewer walks on.
struct FrameTimes {
  std::vector<double> ms;  ///< of each frame
  double cpu_ms = 0.0;     ///< of all cores, per frame
};

Result<FrameTimes> frame_times(render::Renderer& renderer, const scene::Scene& scene, Camera camera,
                               int frames) {
  FrameTimes times;
  std::clock_t before = 0;
  for (int i = 0; i < frames + 2; ++i) {
    camera.world_from_camera =
        glm::translate(glm::mat4(1.0f), {0.02f, 0.02f, 0.0f}) * camera.world_from_camera;
    if (i == 2) before = std::clock();
    Status status = Done{};
    const double ms = milliseconds([&] {
      status = render::draw_frame(renderer, scene, {camera, width, height});
      glFinish();
    });
    if (!status) return status.errors();
    if (i >= 2) times.ms.push_back(ms);  // the first ones draw the shadow maps, which are kept
  }
  times.cpu_ms = 1e3 * double(std::clock() - before) / CLOCKS_PER_SEC / double(frames);
  return times;
}

struct PicturesOfGrove {
  double flip = 0.0, flip_thin = 0.0;  ///< against the real geometry; area not kept
  double flip_full = 0.0;              ///< of the real geometry at the samples that pictures have
  double flip_bare = 0.0;              ///< of a lawn without trees
  double full_ms = 0.0;                ///< what that took
};

Result<PicturesOfGrove> compare_with_real_geometry(render::Renderer& renderer, scene::Scene& scene,
                                                   const Camera& camera) {
  const Result<Image8> truth = drawn_finely(renderer, scene, camera);
  if (!truth) return truth.errors();
  PicturesOfGrove pictures;
  Result<Image8> full = Image8();
  pictures.full_ms = milliseconds([&] { full = drawn(renderer, scene, camera, {.is_full = true}); });
  if (!full) return full.errors();
  const Result<reference::Difference> of_full = reference::compare(*full, *truth);
  if (!of_full) return of_full.errors();
  pictures.flip_full = of_full->flip;
  for (const auto& [detail, flip] :
       {std::pair{PlantDetail{}, &pictures.flip}, {PlantDetail{.keeps_area = false}, &pictures.flip_thin}}) {
    const Result<Image8> picture = drawn(renderer, scene, camera, detail);
    if (!picture) return picture.errors();
    const Result<reference::Difference> difference = reference::compare(*picture, *truth);
    if (!difference) return difference.errors();
    *flip = difference->flip;
  }
  scene::Scene bare = scene;
  show_rows(0, bare);
  const Result<Image8> lawn = drawn(renderer, bare, camera, {});
  if (!lawn) return lawn.errors();
  const Result<reference::Difference> of_lawn = reference::compare(*lawn, *truth);
  if (!of_lawn) return of_lawn.errors();
  pictures.flip_bare = of_lawn->flip;
  return pictures;
}

/// A grove of 200 oaks of a million triangles each. Quality and cost are measured in the same views, and
/// closer, where trees fill the picture.
Status measure(const BenchSetup& setup, Report& report) {
  const Result<gl::Context> context = gl::Context::create_headless();
  if (!context) return context.errors();
  report.note("machine: " + gl::driver_name());
  Result<scene::Scene> grove = make_grove(report);
  if (!grove) return grove.errors();
  scene::Scene& scene = *grove;
  render::Drawables drawables;
  drawables.add(vegetation::scene_plants_kind());
  drawables.furnish(scene);
  auto made = render::Renderer::create(scene, drawables, setup.house.get<render::Lights>().make);
  if (!made) return made.errors();
  render::Renderer& renderer = **made;

  const std::vector<Camera> views = grove_views();
  std::vector<double> slowest, fulls;
  std::size_t maximum = 0, max_full = 0;
  double flip = 0.0, flip_thin = 0.0, flip_full = 0.0, flip_bare = 1e9;
  for (std::size_t v = 0; v < views.size(); ++v) {
    for (const float share_of_angle : {1.0f, closer}) {
      Camera camera = views[v];
      camera.vertical_fov *= share_of_angle;
      const PlantStatistics count = counted(scene, camera, {});
      maximum = std::max(maximum, count.all());
      max_full = std::max(max_full, counted(scene, camera, {.is_full = true}).all());
      const Result<FrameTimes> times = frame_times(renderer, scene, camera, setup.is_quick ? 5 : 15);
      if (!times) return times.errors();
      if (slowest.empty() || median(times->ms).value > median(slowest).value) slowest = times->ms;
      report.note(fmt::format(
          "view {} at {} of its angle: {} triangles, {} points, {} lines; {:.0f} ms per frame, {:.0f} ms of "
          "all cores",
          v, share_of_angle, count.triangles, count.points, count.lines, median(times->ms).value,
          times->cpu_ms));
    }
    if (setup.is_quick && v == 2) continue;
    show_rows(setup.is_quick ? 2 : rows, scene);
    for (const float share_of_angle : {1.0f, closer}) {
      if (setup.is_quick && v == 0 && share_of_angle == closer) continue;
      Camera camera = views[v];
      camera.vertical_fov *= share_of_angle;
      const Result<PicturesOfGrove> pictures = compare_with_real_geometry(renderer, scene, camera);
      if (!pictures) return pictures.errors();
      fulls.push_back(pictures->full_ms);
      flip = std::max(flip, pictures->flip), flip_thin = std::max(flip_thin, pictures->flip_thin);
      flip_full = std::max(flip_full, pictures->flip_full);
      flip_bare = std::min(flip_bare, pictures->flip_bare);
      report.note(
          fmt::format("view {} at {} of its angle: FLIP {:.4f}, area not kept {:.4f}; real geometry: {:.4f}, "
                      "{} triangles in {:.1f} s",
                      v, share_of_angle, pictures->flip, pictures->flip_thin, pictures->flip_full,
                      counted(scene, camera, {.is_full = true}).triangles, pictures->full_ms / 1e3));
    }
    show_rows(rows, scene);
  }
  const Median frame = median(slowest);
  report.add("vegetation_fps_200_trees_1m_triangles", 1e3 / frame.value, Target{10.0, true});
  report.add_control("vegetation_fps_real_geometry_control", 1e3 / median(fulls).value, Target{10.0, true});
  report.note(
      fmt::format("slowest of {} views, {} x {} pixels, a walking viewer; 95 % interval {:.1f} to {:.1f} fps",
                  2 * views.size(), width, height, 1e3 / frame.high, 1e3 / frame.low));
  if (setup.is_quick)
    report.note(
        "FLIP is of the 40 trees nearest to the lawn, cost of all 200; without --quick both are of 200");
  report.note(
      "vegetation_fps_real_geometry_control: one picture of the trees that are compared, its shadow maps "
      "included");
  report.add("vegetation_flip", flip, up_to(0.05));
  report.add_control("vegetation_flip_area_not_kept_control", flip_thin, up_to(0.05));
  report.add("vegetation_flip_of_real_geometry", flip_full);
  if (!(flip_bare > 0.05))
    return error("a lawn without trees has a FLIP of {}: the trees are not drawn", flip_bare);
  report.add_control("vegetation_flip_without_trees_control", flip_bare, up_to(0.05));
  report.note(
      fmt::format("vegetation_flip: against the real geometry with {0} x {0} times the samples of a picture; "
                  "vegetation_flip_of_real_geometry: with those of a picture",
                  supersample));
  report.add("vegetation_primitives", double(maximum), up_to(300'000));
  report.add_control("vegetation_primitives_real_geometry_control", double(max_full), up_to(300'000));
  return Done{};
}

}  // namespace

void furnish_vegetation(House& house) {
  house.get<Benches>().add(
      {"vegetation", "points and lines of grown plants against their real geometry", measure});
}

}  // namespace parvis::bench
