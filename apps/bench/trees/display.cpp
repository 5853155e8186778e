// A wood of a thousand captured trees.

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "bench/parts.h"
#include "bench/reflections/judged_method.h"
#include "bench/trees/reconstructed_tree.h"
#include "capture/trees/scene_tree.h"
#include "capture/trees/tree_drawable.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/tone_curve.h"

namespace parvis::bench {
namespace {

constexpr int width = 1280, height = 720, frames = 5;
constexpr int wood_columns = 25, wood_rows = 40;
const TreeDetail finest{{0.0f, 0.0f}, 0.0f}, coarsest{{1e9f, 1e9f}, 0.0f, {}, 0};
constexpr double min_covered_percent = 20.0;  // below it neither speed nor difference says anything
constexpr float spacing_m = 11.0f, turn = 2.4f;

/// Where a visitor looks from.
struct WoodView {
  const char* name;
  glm::vec3 eye, target;
};
constexpr WoodView wood_views[]{{"at its edge", {0, -18, 4}, {0, 30, 5}},
                                {"from a meadow", {0, -70, 1.7f}, {0, 30, 9}},
                                {"from a hill", {0, -90, 60}, {0, 90, 0}}};

void plant(scene::Scene& scene, const std::shared_ptr<const TreeLevels>& tree) {
  SceneTrees& trees = scene.data<SceneTrees>();
  for (int i = 0; i < wood_columns * wood_rows; ++i) {
    const int row = i / wood_columns;
    const glm::vec3 foot(spacing_m * (float(i % wood_columns) - 0.5f * float(wood_columns - 1)),
                         spacing_m * float(row), 0.0f);
    SceneTree placed;
    placed.tree = tree;
    placed.world_from_tree = glm::translate(
        glm::rotate(glm::translate(glm::mat4(1.0f), foot), turn * float(i), glm::vec3(0, 0, 1)), -tree->foot);
    trees.add(std::move(placed), i);
  }
}

Camera camera_of(const WoodView& view, float aside_m = 0.0f) {
  Camera camera;
  camera.world_from_camera = look_at(view.eye, view.target);
  camera.world_from_camera[3].x += aside_m;
  camera.vertical_fov = 0.7f;
  return camera;
}

/// Tone-mapped.
Image8 picture_of(render::Renderer& renderer, const scene::Scene& scene, const WoodView& view) {
  must(render::draw_frame(renderer, scene, render::EyeView{camera_of(view), width, height}));
  return shading::tone_mapped_picture(renderer.read_radiance(), 1.0f);
}

double percent_of_changed_pixels(const Image8& a, const Image8& b) {
  std::size_t changed = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) changed += !std::equal(a.at(x, y), a.at(x, y) + a.channels, b.at(x, y));
  return 100.0 * double(changed) / (double(a.width) * double(a.height));
}

/// Milliseconds of a frame, the median of a few while the eye moves.
double frame_ms(render::Renderer& renderer, const scene::Scene& scene, const WoodView& view) {
  std::vector<double> samples;
  for (int i = 0; i < frames; ++i)
    samples.push_back(finished_ms([&] {
      must(render::draw_frame(renderer, scene,
                              render::EyeView{camera_of(view, 0.3f * float(i)), width, height}));
    }));
  return median(samples).value;
}

/// Figures of one view, or the worst of several.
struct DisplayFigures {
  double ms = 0.0, covered_percent = 100.0, flip = 0.0, flip_coarsest = 1.0;
  double ms_finest = std::numeric_limits<double>::max();  // the fastest of the views: a control

  void worsen(const DisplayFigures& other) {
    ms = std::max(ms, other.ms), covered_percent = std::min(covered_percent, other.covered_percent);
    flip = std::max(flip, other.flip), flip_coarsest = std::min(flip_coarsest, other.flip_coarsest);
    ms_finest = std::min(ms_finest, other.ms_finest);
  }
};

/// The view as shipped, at the finest level, at the coarsest one, and without the trees.
DisplayFigures figures_of(render::Renderer& renderer, scene::Scene& wood, const WoodView& view) {
  TreeDetail& detail = wood.data<TreeDetail>();
  const auto shown = [&](const TreeDetail& used) {
    detail = used;
    return picture_of(renderer, wood, view);
  };
  const auto show_trees = [&](bool is_visible) {
    for (SceneTree& tree : wood.data<SceneTrees>().items) tree.is_visible = is_visible;
  };
  DisplayFigures figures;
  const Image8 coarse = shown(coarsest);  // first: shadow maps and shaders are ready then
  const Image8 fine = shown(finest);
  figures.ms_finest = frame_ms(renderer, wood, view);
  const Image8 shipped = shown({});
  figures.ms = frame_ms(renderer, wood, view);
  show_trees(false);
  const Image8 empty = picture_of(renderer, wood, view);
  show_trees(true);
  figures.covered_percent = percent_of_changed_pixels(fine, empty);
  figures.flip = flip_between(shipped, fine);
  figures.flip_coarsest = flip_between(coarse, fine);
  return figures;
}

/// All figures of a wood of this tree.
void measure_wood(const std::shared_ptr<const TreeLevels>& tree, Report& report) {
  render::Drawables drawables;
  drawables.add(scene_trees_kind());
  scene::Scene wood;
  drawables.attach(wood);
  plant(wood, tree);
  std::unique_ptr<render::Renderer> renderer =
      must(render::Renderer::create(wood, drawables, light::sun_and_sky));

  DisplayFigures worst;
  for (const WoodView& view : wood_views) worst.worsen(figures_of(*renderer, wood, view));
  if (worst.covered_percent < min_covered_percent)
    fail("trees_1000_fps: the trees cover {:.1f} % of a picture, at least {} % were expected",
         worst.covered_percent, min_covered_percent);
  report.add("trees_1000_fps", 1000.0 / worst.ms);
  report.add("trees_1000_fps_finest", 1000.0 / worst.ms_finest);
  report.add("lod_flip", worst.flip);
  report.add("lod_flip_coarsest", worst.flip_coarsest);
  report.add("trees_1000_covered_percent", worst.covered_percent);
}

}  // namespace

void measure_display(const BenchSetup& setup, Report& report) {
  const BenchCaptureSize size = bench_capture_size(setup);
  measure_wood(reconstructed_tree(sample_capture("oak", 22, size), size).levels, report);
}

}  // namespace parvis::bench
