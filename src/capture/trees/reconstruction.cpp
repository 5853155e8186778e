#include "capture/trees/reconstruction.h"

#include <algorithm>
#include <chrono>
#include <span>

#include "base/progress.h"

namespace parvis::trees {
namespace {

constexpr int cutoff_iterations = 5;  // of the estimates that the cutoff is chosen by

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The views without the one that contradicts all others.
Result<std::vector<TreeView>> consistent(std::span<const TreeView> views, bool leaves_out,
                                         std::vector<std::string>& notes) {
  std::vector<TreeView> result(views.begin(), views.end());
  const std::vector<std::size_t> wrong = inconsistent_views(views, silhouettes(views));
  for (const std::size_t i : wrong) {
    const std::string what =
        views[i].name +
        ": its silhouette contradicts all other photographs: the camera or the matte is wrong";
    if (!leaves_out) return error("{}; mend it, or leave it out with --leave-out-inconsistent", what);
    notes.push_back(what + "; left out");
    result.erase(result.begin() + std::ptrdiff_t(i));
  }
  return result;
}

}  // namespace

Result<Reconstruction> reconstruct(std::span<const TreeView> all, const ReconstructionOptions& options) {
  Reconstruction result;
  Progress progress("reconstructing", 5);
  auto start = std::chrono::steady_clock::now();
  const auto note = [&](const std::string& step, const std::string& what) {
    result.times.push_back({step, seconds_since(start)});
    result.notes.push_back(fmt::format("{}: {:.1f} s", what, result.times.back().seconds));
    start = std::chrono::steady_clock::now();
    progress.advance();
  };
  if (all.size() < 3)
    return error("{} photographs of the tree: at least 3 are needed, 20 to 30 are recommended", all.size());
  const Result<std::vector<TreeView>> views = consistent(all, options.leaves_out_inconsistent, result.notes);
  if (!views) return views.errors();
  const std::vector<Silhouette> masks = silhouettes(*views);
  const Result<Bounds> box = hull_box(*views, masks);
  if (!box) return box.errors();
  Result<CellGrid> grid = hull_grid(*views, masks, *box, options.grid);
  if (!grid) return grid.errors();
  note("hull",
       fmt::format("hull of {} photographs, {} of {}^3 cells", views->size(), grid->size(), grid->side()));

  OpacityOptions opacity = options.opacity;
  opacity.iterations = std::min(opacity.iterations, cutoff_iterations);
  result.cutoff = options.cutoff ? *options.cutoff : cutoff_by_held_out_error(*grid, *views, opacity);
  note("cutoff", fmt::format("cutoff {}", result.cutoff));
  opacity.iterations = options.opacity.iterations, opacity.processes = options.processes;
  result.opacities = estimate_opacity(*grid, *views, masks, opacity);
  note("opacity",
       fmt::format("opacity in {} iterations, mean change {:.4f} to {:.4f}", opacity.iterations,
                   result.opacities.mean_change.empty() ? 0.0 : result.opacities.mean_change.front(),
                   result.opacities.mean_change.empty() ? 0.0 : result.opacities.mean_change.back()));

  result.volume = coloured(*std::move(grid), result.opacities.extinction_per_m, *views);
  FitOptions fit;
  fit.epochs = options.coarse_epochs, fit.processes = options.processes;
  std::vector<double> errors = fit_volume(result.volume, *views, fit);
  result.volume = without_transparent_cells(result.volume, result.cutoff);
  note("colours", fmt::format("colours, {} cells, RMS error {:.4f}", result.volume.grid.size(),
                              errors.empty() ? 0.0 : errors.back()));
  if (options.fine_epochs > 0) {
    Result<TreeVolume> fine = subdivided(result.volume);
    if (!fine) return fine.errors();
    fit.epochs = options.fine_epochs, fit.smoothing = options.fine_smoothing;
    errors = fit_volume(*fine, *views, fit);
    result.volume = without_transparent_cells(*fine, result.cutoff);
    note("finer", fmt::format("one level finer, {} cells, RMS error {:.4f}", result.volume.grid.size(),
                              errors.back()));
  } else {
    progress.advance();
  }
  return result;
}

}  // namespace parvis::trees
