// A wood of a thousand trees at 1280x720, and the picture of a few of them against their finest level.
#include <algorithm>
#include <chrono>
#include <glm/gtc/matrix_transform.hpp>

#include "capture/trees/bench/reconstructed_tree.h"
#include "capture/trees/scene_tree.h"
#include "capture/trees/tree_drawable.h"
#include "capture/trees/tree_light.h"
#include "graphics/reference/metrics.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/tone_curve.h"

namespace parvis::trees {
namespace {

constexpr int width = 1280, height = 720, frames = 5;
constexpr float spacing_m = 11.0f, turn = 2.4f;

void plant(scene::Scene& scene, const std::shared_ptr<const TreeLevels>& tree, int columns, int rows) {
  SceneTrees& trees = scene.data<SceneTrees>();
  for (int i = 0; i < columns * rows; ++i) {
    const glm::vec3 foot(spacing_m * (float(i % columns) - 0.5f * float(columns - 1)),
                         spacing_m * float(i / columns), 0.0f);
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

Result<Image8> picture_of(const scene::Scene& scene, const render::Drawables& drawables) {
  Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create(scene, drawables);
  if (!renderer) return renderer.errors();
  draw(**renderer, scene, from_the_south());
  return shading::tone_mapped_picture((*renderer)->read_radiance(), 1.0f);
}

/// Zero says that no coarser level was drawn, so that `lod_flip` says nothing.
double percent_of_changed_pixels(const Image8& a, const Image8& b) {
  std::size_t changed = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) changed += !std::equal(a.at(x, y), a.at(x, y) + a.channels, b.at(x, y));
  return 100.0 * double(changed) / (double(a.width) * double(a.height));
}

}  // namespace

Status measure_display(const FigureOptions& options, const FigureSink& sink) {
  const BenchCaptureSize size = bench_capture_size(options);
  const Result<SampleCapture> capture = sample_capture("oak", 22, size);
  if (!capture) return capture.errors();
  Result<ReconstructedTree> made = reconstructed_tree(*capture, size);
  if (!made) return made.errors();
  const auto tree = std::make_shared<const TreeLevels>(levels_of(unlit(std::move(made->tree))));
  render::Drawables drawables;
  drawables.add(scene_trees_kind());

  scene::Scene few;
  drawables.furnish(few);
  plant(few, tree, 7, 25);  // as far as 260 m: near trees at their finest level, far ones at coarser ones
  std::vector<Image8> pictures;
  for (const float pixels : {0.0f, TreeDetail().max_texel_pixels, 1e6f}) {
    few.data<TreeDetail>().max_texel_pixels = pixels;
    Result<Image8> picture = picture_of(few, drawables);
    if (!picture) return picture.errors();
    pictures.push_back(*std::move(picture));
  }
  sink.add("lod_flip", reference::compare(pictures[1], pictures[0])->flip);
  sink.add("lod_changed_percent", percent_of_changed_pixels(pictures[1], pictures[0]));
  sink.add("lod_flip_coarsest", reference::compare(pictures[2], pictures[0])->flip);

  scene::Scene wood;
  drawables.furnish(wood);
  plant(wood, tree, 25, 40);
  const auto frames_per_second = [&](const scene::Scene& scene) -> Result<double> {
    Result<std::unique_ptr<render::Renderer>> renderer = render::Renderer::create(scene, drawables);
    if (!renderer) return renderer.errors();
    std::vector<double> seconds;
    for (int i = 0; i <= frames; ++i) {
      Camera camera = from_the_south();
      camera.world_from_camera[3].x += 0.3f * float(i);
      const auto start = std::chrono::steady_clock::now();
      draw(**renderer, scene, camera);
      glFinish();
      if (i > 0)  // the first draws the shadows of the static scene
        seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    }
    std::ranges::sort(seconds);
    return 1.0 / seconds[seconds.size() / 2];
  };
  const Result<double> fps = frames_per_second(wood);
  if (!fps) return fps.errors();
  sink.add("trees_1000_fps", *fps);
  wood.data<TreeDetail>().max_texel_pixels = 0.25f;
  const Result<double> finer = frames_per_second(wood);
  if (!finer) return finer.errors();
  sink.add("trees_1000_fps_at_a_quarter_pixel", *finer);
  return Done{};
}

}  // namespace parvis::trees
