// A wood of a thousand trees at 1280x720: how fast it is drawn, and how its levels of detail differ from
// finer ones in the same picture.
#include <algorithm>
#include <chrono>
#include <glm/gtc/matrix_transform.hpp>

#include "capture/trees/bench/reconstructed_tree.h"
#include "capture/trees/scene_tree.h"
#include "capture/trees/tree_drawable.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/metrics.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/tone_curve.h"

namespace parvis::trees {
namespace {

constexpr int width = 1280, height = 720, frames = 5;
constexpr int wood_columns = 25, wood_rows = 40;
constexpr float fine_texel_pixels = TreeDetail().max_texel_pixels / 4.0f;
constexpr double min_covered_percent = 20.0;  // below it neither speed nor difference says anything
constexpr float spacing_m = 11.0f, turn = 2.4f;

void plant(scene::Scene& scene, const std::shared_ptr<const TreeLevels>& tree) {
  SceneTrees& trees = scene.data<SceneTrees>();
  for (int i = 0; i < wood_columns * wood_rows; ++i) {
    const glm::vec3 foot(spacing_m * (float(i % wood_columns) - 0.5f * float(wood_columns - 1)),
                         spacing_m * float(i / wood_columns), 0.0f);
    SceneTree placed;
    placed.tree = tree;
    placed.world_from_tree = glm::translate(
        glm::rotate(glm::translate(glm::mat4(1.0f), foot), turn * float(i), glm::vec3(0, 0, 1)), -tree->foot);
    trees.add(std::move(placed), i);
  }
}

Camera from_the_south() {
  Camera camera;
  camera.world_from_camera = look_at({0, -18, 4}, {0, 30, 5});
  camera.vertical_fov = 0.7f;
  return camera;
}

void draw(render::Renderer& renderer, const scene::Scene& scene, const Camera& camera) {
  renderer.begin_frame(scene, camera);
  renderer.prepare_main_view(camera, width, height);
  renderer.draw_main_view();
}

/// Tone-mapped.
Image8 picture_of(render::Renderer& renderer, const scene::Scene& scene) {
  draw(renderer, scene, from_the_south());
  return shading::tone_mapped_picture(renderer.read_radiance(), 1.0f);
}

double percent_of_changed_pixels(const Image8& a, const Image8& b) {
  std::size_t changed = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) changed += !std::equal(a.at(x, y), a.at(x, y) + a.channels, b.at(x, y));
  return 100.0 * double(changed) / (double(a.width) * double(a.height));
}

double frames_per_second(render::Renderer& renderer, const scene::Scene& scene) {
  std::vector<double> seconds;
  for (int i = 0; i < frames; ++i) {
    Camera camera = from_the_south();
    camera.world_from_camera[3].x += 0.3f * float(i);
    const auto start = std::chrono::steady_clock::now();
    draw(renderer, scene, camera);
    glFinish();
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  std::ranges::sort(seconds);
  return 1.0 / seconds[seconds.size() / 2];
}

}  // namespace

Status measure_display(const FigureOptions& options, const FigureSink& sink) {
  const BenchCaptureSize size = bench_capture_size(options);
  const Result<SampleCapture> capture = sample_capture("oak", 22, size);
  if (!capture) return capture.errors();
  const Result<ReconstructedTree> made = reconstructed_tree(*capture, size);
  if (!made) return made.errors();
  render::Drawables drawables;
  drawables.add(scene_trees_kind());
  scene::Scene wood;
  drawables.furnish(wood);
  plant(wood, made->levels);
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(wood, drawables, light::sun_and_sky);
  if (!renderer) return renderer.errors();

  // One scene, one camera: as shipped, four times as fine, and as coarse as there is; and without the trees.
  const auto shown = [&](float max_texel_pixels) {
    wood.data<TreeDetail>().max_texel_pixels = max_texel_pixels;
    return picture_of(**renderer, wood);
  };
  const Image8 coarsest = shown(1e6f), finer = shown(fine_texel_pixels),
               shipped = shown(TreeDetail().max_texel_pixels);
  const double fps = frames_per_second(**renderer, wood);
  wood.data<TreeDetail>().max_texel_pixels = fine_texel_pixels;
  const double fps_finer = frames_per_second(**renderer, wood);
  for (SceneTree& tree : wood.data<SceneTrees>().items) tree.is_visible = false;
  const double covered = percent_of_changed_pixels(shipped, picture_of(**renderer, wood));
  if (covered < min_covered_percent)
    return error("trees_1000_fps: the trees cover {:.1f} % of the picture, at least {} % were expected",
                 covered, min_covered_percent);
  const auto flip = [](const Image8& a, const Image8& b) { return reference::compare(a, b)->flip; };
  for (const auto& [key, value] : std::initializer_list<std::pair<const char*, double>>{
           {"trees_1000_fps", fps},
           {"trees_1000_fps_four_times_as_fine", fps_finer},
           {"trees_1000_covered_percent", covered},
           {"lod_flip", flip(shipped, finer)},
           {"lod_changed_percent", percent_of_changed_pixels(shipped, finer)},
           {"lod_flip_coarsest", flip(coarsest, finer)}})
    if (Status status = sink.figure(key, value); !status) return status;
  return Done{};
}

}  // namespace parvis::trees
