#include "capture/trees/bench/tree_figures.h"

#include <algorithm>
#include <barrier>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "base/random.h"
#include "capture/trees/bench/reconstructed_tree.h"
#include "capture/trees/billboard_textures.h"
#include "capture/trees/judge.h"
#include "capture/trees/measure.h"
#include "capture/trees/reconstruction.h"
#include "capture/trees/sample_trees.h"
#include "capture/trees/synthetic_capture.h"
#include "capture/trees/tree_file.h"
#include "capture/trees/tree_light.h"

namespace parvis::trees {
namespace {

constexpr float sun_turn_deg = 60.0f;  // of the relit tree
constexpr float wrong_height = 1.05f;  // a tree so much taller must be noticed
constexpr int thesis_iterations = 4;

/// Sums over trees, reported as means.
class Means {
 public:
  void add(const std::string& key, double value) {
    auto entry = std::ranges::find(entries_, key, &Entry::key);
    if (entry == entries_.end()) entry = entries_.insert(entries_.end(), Entry{key, 0.0, 0.0});
    entry->sum += value, entry->count += 1.0;
  }
  void report(const FigureSink& sink) const {
    for (const Entry& entry : entries_) sink.add(entry.key, entry.sum / entry.count);
  }

 private:
  struct Entry {
    std::string key;
    double sum, count;
  };
  std::vector<Entry> entries_;
};

/// Mean errors of what a tree shows from the places of views; alpha's root mean square over all of them.
ViewErrors errors_of(const BillboardTree& tree, std::span<const TreeView> views) {
  ViewErrors mean;
  double squares = 0.0;
  for (const TreeView& view : views) {
    const ViewErrors one = *judged(render_billboards(tree, view.camera), view);
    mean += one, squares += one.alpha_rmse * one.alpha_rmse;
  }
  mean /= double(views.size());
  mean.alpha_rmse = std::sqrt(squares / double(views.size()));
  return mean;
}

/// Against the thesis's opacities on the same grid, clamped; the control is their start.
Status measure_opacity(const SampleCapture& capture, const ReconstructionOptions& options,
                       double alpha_rmse_of_ours, Means& means) {
  const std::vector<Silhouette> masks = silhouettes(capture.views);
  const Result<Bounds> box = hull_box(capture.views, masks);
  if (!box) return box.errors();
  const Result<CellGrid> grid = hull_grid(capture.views, masks, *box, options.grid);
  if (!grid) return grid.errors();
  OpacityOptions thesis;
  thesis.method = OpacityMethod::projection, thesis.iterations = thesis_iterations;
  const Opacities found = estimate_opacity(*grid, capture.views, masks, thesis);
  const double projection = alpha_rmse(*grid, found.extinction_per_m, capture.held_out, 1);
  means.add("alpha_rmse_ratio_over_projection", alpha_rmse_of_ours / projection);
  means.add("alpha_rmse_ratio_of_the_start",
            alpha_rmse(*grid, initial_extinction(*grid, masks), capture.held_out, 1) / projection);
  return Done{};
}

void measure_sizes(const ReconstructedTree& made, const scene::Model& model, Means& means) {
  const TreeMeasures truth = measured(model), found = measured(made.volume);
  const auto percent = [](float value, float expected) {
    return 100.0 * std::abs(double(value / expected) - 1.0);
  };
  means.add("measure_height_error_percent", percent(found.height_m, truth.height_m));
  means.add("measure_height_error_percent_5_too_tall",
            percent(wrong_height * truth.height_m, truth.height_m));
  means.add("measure_crown_volume_error_percent", percent(found.crown_volume_m3, truth.crown_volume_m3));
  means.add(
      "measure_crown_volume_error_percent_5_too_wide",
      percent(wrong_height * wrong_height * wrong_height * truth.crown_volume_m3, truth.crown_volume_m3));
}

/// The sun moves by 60 degrees: FLIP against photographs under that sun, over that of the textures as they
/// are.
void measure_relighting(const SampleCapture& capture, const BillboardTree& tree,
                        const CaptureOptions& options, Means& means) {
  CaptureLight moved;
  moved.sun_azimuth_deg += sun_turn_deg;
  const scene::Scene truth_scene = capture_scene(capture.model, moved);
  const std::vector<TreeView> truth =
      photograph_tree(truth_scene, capture.held_out_cameras, "relit", options);
  moved.sun_azimuth_deg -= 2.0f * sun_turn_deg;
  const double baked = errors_of(tree, truth).flip;
  means.add("relight_flip_over_baked",
            errors_of(relit(tree, truth_scene.sun.direction_to_sun), truth).flip / baked);
  means.add(
      "relight_flip_over_baked_to_the_wrong_side",
      errors_of(relit(tree, capture_scene(capture.model, moved).sun.direction_to_sun), truth).flip / baked);
}

/// The estimate by two groups of photographs that add up their sums in each iteration, against all in one.
Status measure_distribution(const SampleCapture& capture, const FigureSink& sink) {
  const std::vector<Silhouette> masks = silhouettes(capture.views);
  const Result<Bounds> box = hull_box(capture.views, masks);
  if (!box) return box.errors();
  const Result<CellGrid> grid = hull_grid(capture.views, masks, *box, {3, 3});
  if (!grid) return grid.errors();
  OpacityOptions options;
  options.picture_factor = 2;
  const std::vector<float> one = estimate_opacity(*grid, capture.views, masks, options).extinction_per_m;
  const std::span<const TreeView> all(capture.views);
  const std::array groups{all.first(all.size() / 2), all.subspan(all.size() / 2)};
  std::array<std::vector<float>, 2> results, sums;
  std::barrier meeting(2);
  const auto estimate = [&](std::size_t group) {
    OpacityOptions own = options;
    own.sum_over_processes = [&, group](std::span<float> values) {
      sums[group].assign(values.begin(), values.end());
      meeting.arrive_and_wait();
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = sums[0][i] + sums[1][i];
      meeting.arrive_and_wait();
    };
    results[group] = estimate_opacity(*grid, groups[group], masks, own).extinction_per_m;
  };
  std::thread other(estimate, 1);
  estimate(0);
  other.join();
  const float chord_m = mean_chord_m(grid->cell_size_m());
  const auto difference = [&](const std::vector<float>& tau) {
    double most = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i)
      most =
          std::max(most, std::abs(std::exp(-double(tau[i] * chord_m)) - std::exp(-double(one[i] * chord_m))));
    return most;
  };
  sink.add("mpi_2_over_1_difference", std::max(difference(results[0]), difference(results[1])));
  sink.add("mpi_2_over_1_difference_without_the_sum",
           difference(estimate_opacity(*grid, groups[0], masks, options).extinction_per_m));
  sink.note("two groups of photographs in two threads of one process: transparencies of the cells");
  return Done{};
}

Status measure_tree(std::string_view name, const FigureOptions& options, Means& means,
                    const FigureSink& sink) {
  const BenchCaptureSize size = bench_capture_size(options);
  Result<SampleCapture> capture = sample_capture(name, 22, size);
  if (!capture) return capture.errors();
  Result<ReconstructedTree> made = reconstructed_tree(*capture, size);
  if (!made) return made.errors();
  const ViewErrors left_out = errors_of(made->tree, capture->held_out),
                   seen = errors_of(made->tree, capture->views);
  means.add("psnr_db_22", left_out.psnr_db);
  means.add("input_view_psnr_db", seen.psnr_db);
  means.add("minutes_22", made->seconds / 60.0);
  means.add("cells", double(made->tree.grid.size()));
  if (name == "oak") sink.add("tree_mb", made->megabytes);
  for (const std::string& row : made->notes) sink.note(fmt::format("{}, 22 photographs: {}", name, row));
  TextureOptions naive;
  naive.method = TextureMethod::naive;
  const BillboardTree naive_tree = textured(made->volume, capture->views, naive);
  means.add("psnr_db_22_naive", errors_of(naive_tree, capture->held_out).psnr_db);
  means.add("input_view_psnr_db_naive", errors_of(naive_tree, capture->views).psnr_db);
  if (Status status = measure_opacity(*capture, size.options, left_out.alpha_rmse, means); !status)
    return status;
  measure_sizes(*made, capture->model, means);
  measure_relighting(*capture, made->tree, size.capture, means);
  if (name == "oak")
    if (Status status = measure_distribution(*capture, sink); !status) return status;

  Result<SampleCapture> many = sample_capture(name, 100, size);
  if (!many) return many.errors();
  made = reconstructed_tree(*many, size);
  if (!made) return made.errors();
  const ViewErrors of_many = errors_of(made->tree, many->held_out);
  means.add("psnr_db_100", of_many.psnr_db), means.add("ssim_100", of_many.ssim);
  means.add("flip_100", of_many.flip), means.add("minutes_100", made->seconds / 60.0);
  return Done{};
}

}  // namespace

Status measure_reconstruction(const FigureOptions& options, const FigureSink& sink) {
  Means means;
  for (const std::string_view name : sample_tree_names) {
    if (options.is_quick && name != "oak" && name != "winter") continue;
    if (Status status = measure_tree(name, options, means, sink); !status) return status;
  }
  sink.add("iterations", double(OpacityOptions{}.iterations));
  means.report(sink);
  return Done{};
}

}  // namespace parvis::trees
