// A wood of a thousand trees at 1280x720: how fast it is drawn, and how its levels of detail differ from the
// finest one, in the same views.
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <map>

#include "bench/trees/reconstructed_tree.h"
#include "capture/trees/level_choice.h"
#include "capture/trees/scene_tree.h"
#include "capture/trees/tree_drawable.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/reference/metrics.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "graphics/shading/tone_curve.h"

namespace parvis::trees {
namespace {

constexpr int width = 1280, height = 720, frames = 5;
constexpr int wood_columns = 25, wood_rows = 40;
const TreeDetail finest{{0.0f, 0.0f}, 0.0f}, coarsest{{1e9f, 1e9f}, 0.0f, {}, 0};
constexpr bench::Target max_lod_flip{0.05, false}, min_fps{10.0, true};  // the issue's
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
Result<Image8> picture_of(render::Renderer& renderer, const scene::Scene& scene, const WoodView& view) {
  if (Status status = render::draw_frame(renderer, scene, render::EyeView{camera_of(view), width, height});
      !status)
    return status.errors();
  return shading::tone_mapped_picture(renderer.read_radiance(), 1.0f);
}

double percent_of_changed_pixels(const Image8& a, const Image8& b) {
  std::size_t changed = 0;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) changed += !std::equal(a.at(x, y), a.at(x, y) + a.channels, b.at(x, y));
  return 100.0 * double(changed) / (double(a.width) * double(a.height));
}

/// Milliseconds of each pass of a frame, the medians of a few while the eye moves.
Result<std::map<std::string, double>> pass_times_ms(render::Renderer& renderer, const scene::Scene& scene,
                                                    const WoodView& view) {
  std::map<std::string, std::vector<double>> times;
  for (int i = 0; i < frames; ++i) {
    auto start = std::chrono::steady_clock::now();
    const auto begin = start;
    const std::clock_t cpu = std::clock();
    render::FrameSteps steps;
    const auto milliseconds = [](auto duration) {
      return std::chrono::duration<double, std::milli>(duration).count();
    };
    steps.end_pass = [&](const char* pass) {
      glFinish();
      const auto now = std::chrono::steady_clock::now();
      times[pass].push_back(milliseconds(now - start));
      start = now;
    };
    const render::EyeView eye{camera_of(view, 0.3f * float(i)), width, height};
    if (Status status = render::draw_frame(renderer, scene, eye, steps); !status) return status.errors();
    times["processor time"].push_back(1000.0 * double(std::clock() - cpu) / CLOCKS_PER_SEC);
    times["frame"].push_back(milliseconds(std::chrono::steady_clock::now() - begin));
  }
  std::map<std::string, double> medians;
  for (auto& [pass, all] : times) {
    std::ranges::sort(all);
    medians[pass] = all[all.size() / 2];
  }
  return medians;
}

/// What a view draws.
struct Drawn {
  std::vector<std::size_t> trees_of_level;
  std::size_t billboards = 0;
};

Drawn drawn_in(const scene::Scene& scene, const WoodView& at) {
  const render::View view = render::camera_view(camera_of(at), 0, width, height);
  const render::Culling culling(view, nullptr);
  std::vector<std::pair<float, TreeInView>> in_view;
  for (const SceneTree& tree : scene_trees(scene)) {
    const Bounds bounds = transformed(tree.world_from_tree, tree.tree->box);
    if (!culling.may_see(bounds)) continue;
    in_view.emplace_back(glm::distance(bounds.centre(), view.position_in_world),
                         TreeInView{tree.tree.get(), seen_tree(tree, bounds, view, culling)});
  }
  std::ranges::sort(in_view, {}, &std::pair<float, TreeInView>::first);
  std::vector<TreeInView> ordered;
  ordered.reserve(in_view.size());
  for (const auto& [distance, tree] : in_view) ordered.push_back(tree);
  const std::vector<std::size_t> levels = levels_in_view(ordered, scene.data<TreeDetail>());
  Drawn drawn;
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    const std::vector<BillboardTree>& own = ordered[i].tree->levels;
    drawn.trees_of_level.resize(own.size());
    ++drawn.trees_of_level[levels[i]];
    drawn.billboards += own[levels[i]].grid.size();
  }
  return drawn;
}

/// Of one view, or the worst of several.
struct DisplayFigures {
  double ms = 0.0, covered_percent = 100.0, flip = 0.0, flip_coarsest = 1.0, changed_percent = 100.0;
  double ms_finest = std::numeric_limits<double>::max();  // the fastest of the views: a control
  std::size_t billboards = 0, billboards_finest = 0;

  void worsen(const DisplayFigures& other) {
    ms = std::max(ms, other.ms), covered_percent = std::min(covered_percent, other.covered_percent);
    flip = std::max(flip, other.flip), flip_coarsest = std::min(flip_coarsest, other.flip_coarsest);
    changed_percent = std::min(changed_percent, other.changed_percent);
    ms_finest = std::min(ms_finest, other.ms_finest);
    billboards = std::max(billboards, other.billboards);
    billboards_finest = std::max(billboards_finest, other.billboards_finest);
  }
};

/// The view as shipped, at the finest level, at the coarsest one, and without the trees.
Result<DisplayFigures> figures_of(render::Renderer& renderer, scene::Scene& wood, const WoodView& view,
                                  bench::Report& report) {
  TreeDetail& detail = wood.data<TreeDetail>();
  const auto shown = [&](const TreeDetail& used) {
    detail = used;
    return picture_of(renderer, wood, view);
  };
  const auto show_trees = [&](bool is_visible) {
    for (SceneTree& tree : wood.data<SceneTrees>().items) tree.is_visible = is_visible;
  };
  DisplayFigures figures;
  const Result<Image8> coarse = shown(coarsest);  // first: shadow maps and shaders are ready then
  const Result<Image8> fine = shown(finest);
  const Result<std::map<std::string, double>> times_finest = pass_times_ms(renderer, wood, view);
  figures.billboards_finest = drawn_in(wood, view).billboards;
  const Result<Image8> shipped = shown({});
  const Drawn drawn = drawn_in(wood, view);
  figures.billboards = drawn.billboards;
  const Result<std::map<std::string, double>> times = pass_times_ms(renderer, wood, view);
  show_trees(false);
  const Result<Image8> empty = picture_of(renderer, wood, view);
  const Result<std::map<std::string, double>> empty_times = pass_times_ms(renderer, wood, view);
  show_trees(true);
  for (const auto* picture : {&fine, &coarse, &shipped, &empty})
    if (!*picture) return picture->errors();
  for (const auto* of : {&times, &times_finest, &empty_times})
    if (!*of) return of->errors();
  figures.ms = times->at("frame"), figures.ms_finest = times_finest->at("frame");
  figures.covered_percent = percent_of_changed_pixels(*fine, *empty);
  figures.changed_percent = percent_of_changed_pixels(*shipped, *fine);
  figures.flip = reference::compare(*shipped, *fine)->flip;
  figures.flip_coarsest = reference::compare(*coarse, *fine)->flip;
  report.note(fmt::format(
      "wood {}: trees per level {}, billboards {} (finest: {}); shadows {:.1f} ms, choice {:.1f} ms, picture "
      "{:.1f} ms (without trees {:.1f}); FLIP {:.4f} (coarsest {:.4f}); covered {:.1f} %; processor time "
      "{:.0f} ms (without trees {:.0f})",
      view.name, fmt::join(drawn.trees_of_level, " "), figures.billboards, figures.billboards_finest,
      times->at("shadows"), times->at("reflections"), times->at("picture"), empty_times->at("picture"),
      figures.flip, figures.flip_coarsest, figures.covered_percent, times->at("processor time"),
      empty_times->at("processor time")));
  return figures;
}

/// All figures of a wood of this tree.
Status measure_wood(const std::shared_ptr<const TreeLevels>& tree, bench::Report& report) {
  render::Drawables drawables;
  drawables.add(scene_trees_kind());
  scene::Scene wood;
  drawables.furnish(wood);
  plant(wood, tree);
  Result<std::unique_ptr<render::Renderer>> renderer =
      render::Renderer::create(wood, drawables, light::sun_and_sky);
  if (!renderer) return renderer.errors();

  DisplayFigures worst;
  for (const WoodView& view : wood_views) {
    const Result<DisplayFigures> figures = figures_of(**renderer, wood, view, report);
    if (!figures) return figures.errors();
    worst.worsen(*figures);
  }
  if (worst.covered_percent < min_covered_percent)
    return error("trees_1000_fps: the trees cover {:.1f} % of a picture, at least {} % were expected",
                 worst.covered_percent, min_covered_percent);
  report.add("trees_1000_fps", 1000.0 / worst.ms, min_fps);
  report.add_control("trees_1000_fps_finest", 1000.0 / worst.ms_finest, min_fps);
  report.add("lod_flip", worst.flip, max_lod_flip);
  report.add_control("lod_flip_coarsest", worst.flip_coarsest, max_lod_flip);
  report.add("lod_changed_percent", worst.changed_percent);
  report.add("trees_1000_covered_percent", worst.covered_percent);
  report.add("trees_1000_billboards", double(worst.billboards));
  report.add("trees_1000_billboards_finest", double(worst.billboards_finest));
  return Done{};
}

}  // namespace

Status measure_display(const FigureOptions& options, bench::Report& report) {
  const BenchCaptureSize size = bench_capture_size(options);
  const Result<SampleCapture> capture = sample_capture("oak", 22, size);
  if (!capture) return capture.errors();
  const Result<ReconstructedTree> made = reconstructed_tree(*capture, size);
  if (!made) return made.errors();
  return measure_wood(made->levels, report);
}

}  // namespace parvis::trees
