// Captured trees against photographs that were held out, time and memory.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "base/files.h"
#include "bench/own_program.h"
#include "bench/parts.h"
#include "bench/trees/reconstructed_tree.h"
#include "capture/trees/capture_folder.h"
#include "capture/trees/crossed_billboards.h"
#include "capture/trees/measure.h"
#include "capture/trees/sample_trees.h"
#include "capture/trees/shown_tree.h"
#include "capture/trees/tree_file.h"
#include "graphics/gl/context.h"

namespace parvis::bench {
namespace {

constexpr float sun_turn_deg = 60.0f;  // of the relit tree
constexpr float wrong_scale = 1.1f;    // of a reconstruction that is measured wrongly
constexpr int thesis_iterations = 4;
constexpr float thesis_cutoff = 0.94f;  // of its oak

/// The hull's cells, as the thesis has them.
CellGrid thesis_grid(const SampleCapture& capture, const GridOptions& grid) {
  const std::vector<Silhouette> masks = silhouettes(capture.views);
  const Bounds box = must(hull_box(capture.views, masks));
  return must(hull_grid(capture.views, masks, box, grid));
}

OpacityOptions thesis_opacity() {
  OpacityOptions options;
  options.method = OpacityMethod::projection, options.iterations = thesis_iterations;
  return options;
}

/// The thesis's tree: its opacities, clamped, with a cutoff, and its textures.
std::shared_ptr<const TreeLevels> thesis_tree(const SampleCapture& capture, const CellGrid& cells,
                                              OpacityOptions options, float cutoff) {
  options.cutoff = cutoff;
  std::vector<float> extinction =
      estimate_opacity(cells, capture.views, silhouettes(capture.views), options).extinction_per_m;
  const TreeVolume volume =
      without_transparent_cells(coloured(cells, std::move(extinction), capture.views), cutoff);
  TextureOptions textures;
  textures.method = TextureMethod::age_importance, textures.parent_levels = 0;
  return std::make_shared<const TreeLevels>(levels_of(as_stored(textured(volume, capture.views, textures))));
}

/// Compares with the thesis's tree as the same house draws it, with its cutoff or that which photographs that
/// are held out choose, as for ours, whichever is better; the control is the thesis's start.
void measure_opacity(const SampleCapture& capture, const BenchCaptureSize& size, double alpha_rmse_of_ours,
                     Means& means) {
  const CellGrid cells = thesis_grid(capture, size.options.grid);
  std::shared_ptr<const TreeLevels> tree = thesis_tree(capture, cells, thesis_opacity(), thesis_cutoff);
  ViewErrors thesis = errors_of(tree, capture.held_out);
  const float chosen_cutoff = cutoff_by_held_out_error(cells, capture.views, thesis_opacity());
  if (chosen_cutoff != thesis_cutoff) {
    tree = thesis_tree(capture, cells, thesis_opacity(), chosen_cutoff);
    const ViewErrors chosen = errors_of(tree, capture.held_out);
    if (chosen.alpha_rmse < thesis.alpha_rmse) thesis = chosen;
  }
  OpacityOptions start = thesis_opacity();
  start.iterations = 0;
  const ViewErrors of_start = errors_of(thesis_tree(capture, cells, start, thesis_cutoff), capture.held_out);
  means.add("psnr_db_22_of_the_thesis", thesis.psnr_db);
  means.add("alpha_rmse_ratio_over_projection", alpha_rmse_of_ours / thesis.alpha_rmse);
  means.add("alpha_rmse_ratio_over_projection_of_the_start", of_start.alpha_rmse / thesis.alpha_rmse);
}

/// The volume as from cameras whose distances are wrong by a factor.
TreeVolume scaled(const TreeVolume& volume, float scale) {
  TreeVolume wrong = volume;
  const Bounds box = volume.grid.box();
  wrong.grid = CellGrid({scale * box.min, scale * box.max}, volume.grid.branching(), volume.grid.side(),
                        volume.grid.cells());
  return wrong;
}

/// The control measures the same tree too large and too small, and has the greater error of the two: one
/// alone could make up for an error that is there.
void measure_sizes(const TreeVolume& volume, const scene::Model& model, Means& means) {
  const TreeMeasures truth = measured(model);
  const TreeMeasures found = measured(volume), of_larger = measured(scaled(volume, wrong_scale)),
                     of_smaller = measured(scaled(volume, 1.0f / wrong_scale));
  const auto add = [&](const std::string& key, float TreeMeasures::*value) {
    const auto percent = [&](const TreeMeasures& of) {
      return 100.0 * std::abs(double((of.*value) / (truth.*value)) - 1.0);
    };
    means.add(key, percent(found));
    means.add(key + "_at_a_wrong_scale", std::max(percent(of_larger), percent(of_smaller)));
  };
  add("measure_height_error_percent", &TreeMeasures::height_m);
  add("measure_crown_volume_error_percent", &TreeMeasures::crown_volume_m3);
}

/// The scene's sun moves by 60 degrees: FLIP of what Parvis draws against photographs under that sun, over
/// that of the tree as it was photographed; the control is lit from the wrong side. Beside it what no
/// separation of light from texture could undercut: the same volume with textures photographed under that
/// sun.
void measure_relighting(const SampleCapture& capture, const ReconstructedTree& made,
                        const BenchCaptureSize& size, Means& means) {
  const std::shared_ptr<const TreeLevels>& tree = made.levels;
  CaptureLight moved;
  moved.sun_azimuth_deg += sun_turn_deg;
  const scene::Scene truth_scene = capture_scene(capture.model, moved);
  const std::vector<TreeView> truth =
      photograph_tree(truth_scene, capture.held_out_cameras, "relit", truth_options(size));
  moved.sun_azimuth_deg -= 2.0f * sun_turn_deg;
  scene::Scene light = scene_in_light_of(tree->levels.front().light);
  const ViewErrors baked = errors_of(tree, light, truth);
  light.sun.direction_to_sun = truth_scene.sun.direction_to_sun;
  const ViewErrors relit = errors_of(tree, light, truth);
  light.sun.direction_to_sun = capture_scene(capture.model, moved).sun.direction_to_sun;
  const ViewErrors wrong = errors_of(tree, light, truth);
  means.add("relight_flip_over_baked", relit.flip / baked.flip);
  means.add("relight_flip_over_baked_to_the_wrong_side", wrong.flip / baked.flip);
  const std::vector<TreeView> views =
      photograph_tree(truth_scene, capture_cameras(scene::bounds(capture.model), int(capture.views.size())),
                      "relit textures", size.capture);
  const TreeVolume volume = coloured(made.volume.grid, made.volume.extinction_per_m, views);
  const ViewErrors perfect = errors_of(levels_from(volume, views, TextureMethod::optimised), truth);
  means.add("relight_flip_over_baked_of_perfect_separation", perfect.flip / baked.flip);
}

/// The baseline of two crossed billboards.
ViewErrors errors_of_crossed(const SampleCapture& capture) {
  const CrossedBillboards crossed = crossed_billboards(capture.views, scene::bounds(capture.model));
  ViewErrors mean;
  for (const TreeView& view : capture.held_out) {
    const ViewErrors one = must(judged(render_crossed_billboards(crossed, view.camera), view));
    mean += one;
  }
  mean /= double(capture.held_out.size());
  return mean;
}

/// Errors of pictures in which there is no tree: the worth of a white background alone.
ViewErrors errors_of_nothing(std::span<const TreeView> views) {
  ViewErrors mean;
  for (const TreeView& view : views) {
    const ViewErrors one = must(judged(ImageF(view.picture.width, view.picture.height, 4), view));
    mean += one;
  }
  mean /= double(views.size());
  return mean;
}

/// Minutes are those of the wall clock over all steps. The control takes seconds for minutes: it reaches the
/// target where hardly anything was done, or hardly anything of it was timed.
void add_steps(const ReconstructedTree& made, const std::string& photographs, Means& means) {
  for (const StepTime& time : made.times)
    means.add(fmt::format("seconds_{}_{}", time.step, photographs), time.seconds);
  means.add("minutes_" + photographs, made.seconds / 60.0);
  means.add("minutes_" + photographs + "_if_seconds_were_minutes", made.seconds);
}

void measure_many(const SampleCapture& few, const BenchCaptureSize& size, Means& means) {
  const SampleCapture capture = with_photographs(few, size.many, size);
  const ReconstructedTree made = reconstructed_tree(capture, size);
  const ViewErrors errors = errors_of(made.levels, capture.held_out);
  means.add("psnr_db_100", errors.psnr_db);
  means.add("ssim_100", errors.ssim);
  const ViewErrors naive =
      errors_of(levels_from(made.volume, capture.views, TextureMethod::naive), capture.held_out);
  means.add("psnr_db_100_naive", naive.psnr_db);
  means.add("ssim_100_naive", naive.ssim);
  add_steps(made, "100", means);
}

void measure_tree(std::string_view name, const BenchSetup& setup, Means& means, Report& report) {
  const BenchCaptureSize size = bench_capture_size(setup);
  const SampleCapture capture = sample_capture(name, 22, size);
  const ReconstructedTree made = reconstructed_tree(capture, size);
  for (const std::string& row : made.notes) report.note(fmt::format("{}, 22 photographs: {}", name, row));
  const ViewErrors left_out = errors_of(made.levels, capture.held_out);
  const ViewErrors seen = errors_of(made.levels, capture.views);
  means.add("psnr_db_22", left_out.psnr_db);
  means.add("input_view_psnr_db", seen.psnr_db);
  const auto naive = levels_from(made.volume, capture.views, TextureMethod::naive);
  const ViewErrors naive_left_out = errors_of(naive, capture.held_out);
  const ViewErrors naive_seen = errors_of(naive, capture.views);
  means.add("psnr_db_22_naive", naive_left_out.psnr_db);
  const ViewErrors nothing = errors_of_nothing(capture.held_out);
  means.add("psnr_db_22_of_an_empty_picture", nothing.psnr_db);
  const ViewErrors crossed = errors_of_crossed(capture);
  means.add("psnr_db_22_crossed_billboards", crossed.psnr_db);
  means.add("input_view_psnr_db_naive", naive_seen.psnr_db);
  add_steps(made, "22", means);
  const BillboardTree& tree = made.levels->levels.front();
  if (name == "oak") {
    std::size_t texels = 0;
    for (const BillboardTextures& view : tree.views) texels += view.texels.size();
    report.add("tree_mb", made.megabytes);
    report.add("tree_mb_uncompressed", 1e-6 * double(texels));
  }
  measure_opacity(capture, size, left_out.alpha_rmse, means);
  measure_sizes(made.volume, capture.model, means);
  measure_relighting(capture, made, size, means);
  measure_many(capture, size, means);
}

constexpr int photographs = 12, iterations = 20;

/// Transparencies by the places of the cells.
using Cells = std::map<std::tuple<int, int, int>, double>;

/// How the command is run.
struct Run {
  std::string before;  ///< what starts it
  int processes = 1;   ///< that work together then
  int iterations = bench::iterations;
};

/// The cells that a run of the command finds.
Cells cells_of_run(const BenchSetup& setup, const Run& run) {
  const std::filesystem::path file = setup.folder / "run.volume";
  std::filesystem::remove(file);  // it is that of the run before
  const OwnRun ran = run_own_program(
      run.before, {"tree", "reconstruct", (setup.folder / "capture").string(), "-o", file.string(), "--level",
                   "3", "--iterations", std::to_string(run.iterations)});
  if (ran.output.find(fmt::format(" MB, {} process{}\n", run.processes, run.processes == 1 ? "" : "es")) ==
      std::string::npos)
    fail("{} processes were to work together, but the command does not say so: {}", run.processes,
         ran.output);
  const TreeVolume volume = must(read_volume(file));
  Cells cells;
  for (std::size_t i = 0; i < volume.grid.size(); ++i) {
    const glm::ivec3 place(volume.grid.cells()[i]);
    cells[{place.x, place.y, place.z}] = 1.0 - double(volume.alpha(i));
  }
  if (cells.empty()) fail("{}: no cells were found", file.string());
  return cells;
}

/// A cell that only one of the two has counts as a difference of all its opacity.
double max_difference(const Cells& a, const Cells& b) {
  double max = 0.0;
  const auto compare = [&](const Cells& these, const Cells& those) {
    for (const auto& [place, transparency] : these) {
      const auto other = those.find(place);
      max = std::max(max, std::abs(transparency - (other == those.end() ? 1.0 : other->second)));
    }
  };
  compare(a, b), compare(b, a);
  return max;
}

}  // namespace

void measure_reconstruction(const BenchSetup& setup, Report& report) {
  Means means(report);
  for (const std::string_view name : sample_tree_names) {
    if (setup.is_quick && name != "oak" && name != "winter") continue;
    means.begin_tree(name);
    measure_tree(name, setup, means, report);
  }
  means.report();
}

void measure_distribution(const BenchSetup& setup, Report& report) {
  const std::string key = "mpi_2_over_1_difference",
                    mpirun = "mpirun --allow-run-as-root --oversubscribe -n 2 ";
  if (!has_program("mpirun")) return report.skip(key, "there is no mpirun here: package openmpi-bin");
  BenchCaptureSize size = bench_capture_size(setup);
  size.held_out = 1;
  must(write_capture(setup.folder / "capture", sample_capture("winter", photographs, size).views));
  const Cells one = cells_of_run(setup, {}), two = cells_of_run(setup, {mpirun, 2}),
              less = cells_of_run(setup, {"", 1, iterations - 1});
  report.add(key, max_difference(one, two));
  report.add(key + "_one_iteration_less", max_difference(one, less));
}

}  // namespace parvis::bench
