#include "capture/trees/reconstruction.h"

#include <algorithm>
#include <chrono>
#include <ranges>
#include <span>
#include <utility>

#include "base/progress.h"
#include "base/sealed_file.h"
#include "capture/trees/consistent_views.h"
#include "capture/trees/kept_reconstruction.h"

namespace parvis::trees {
namespace {

constexpr int cutoff_iterations = 5;  // of the estimates that the cutoff is chosen by

/// Kept results of an earlier call.
struct Found {
  std::optional<float> cutoff;
  std::optional<Opacities> opacities;
  std::optional<FittedVolume> colours, finer;

  Found(const StepKeeper& keeper, const KeptSteps& steps) {
    const std::string bytes = keeper.find(steps.cutoff);
    ByteReader reader(bytes);
    if (const auto value = reader.take<float>(); reader.is_at_end()) cutoff = value;
    opacities = opacities_of(keeper.find(steps.opacity));
    colours = fitted_volume_of(keeper.find(steps.colours));
    finer = fitted_volume_of(keeper.find(steps.finer));
  }
};

/// One call: the steps in their order.
class Work {
 public:
  Work(std::span<const TreeView> views, const ReconstructionOptions& options)
      : all_(views),
        options_(options),
        steps_(KeptSteps::of(views, options)),
        keeper_(options),
        found_(keeper_, steps_),
        progress_("reconstructing", passes_to_do()) {}

  Result<Reconstruction> run() {
    std::vector<Silhouette> masks = silhouettes(all_);
    const std::vector<TreeView> fewer = without_inconsistent(masks);
    const std::span<const TreeView> views = fewer.empty() ? all_ : std::span<const TreeView>(fewer);
    const Result<Bounds> box = hull_box(views, masks);
    if (!box) return box.errors();
    Result<CellGrid> grid = hull_grid(views, masks, *box, options_.grid);
    if (!grid) return grid.errors();
    progress_.advance(all_.size());
    note("hull",
         fmt::format("hull of {} photographs, {} of {}^3 cells", views.size(), grid->size(), grid->side()));
    if (Status status = choose_cutoff(*grid, views); !status) return status.errors();
    if (Status status = estimate(*grid, views, masks); !status) return status.errors();
    std::exchange(masks, {});  // they take as much memory as the photographs
    if (Status status = fit_colours(*std::move(grid), views); !status) return status.errors();
    if (options_.fine_epochs > 0)
      if (Status status = fit_finer(views); !status) return status.errors();
    return std::move(result_);
  }

 private:
  /// The photographs without those that contradict all others, and `masks` without theirs; empty where none
  /// is left out, so that photographs are not held twice.
  std::vector<TreeView> without_inconsistent(std::vector<Silhouette>& masks) {
    const std::vector<std::size_t> wrong = inconsistent_views(all_, masks);
    result_.notes = inconsistency_notes(all_, wrong, options_.keeps_inconsistent);
    if (wrong.empty() || options_.keeps_inconsistent) return {};
    std::vector<TreeView> views(all_.begin(), all_.end());
    for (const std::size_t i : std::views::reverse(wrong)) {
      views.erase(views.begin() + std::ptrdiff_t(i));
      masks.erase(masks.begin() + std::ptrdiff_t(i));
    }
    return views;
  }
  FitOptions coarse_fit() const {
    FitOptions fit;
    fit.epochs = options_.coarse_epochs, fit.processes = options_.processes;
    return fit;
  }
  FitOptions fine_fit() const {
    FitOptions fit;
    fit.epochs = options_.fine_epochs, fit.processes = options_.processes;
    fit.smoothing = options_.fine_smoothing;
    return fit;
  }
  OpacityOptions cutoff_estimate() const {
    OpacityOptions opacity = options_.opacity;
    opacity.iterations = std::min(opacity.iterations, cutoff_iterations);
    opacity.processes = options_.processes;
    return opacity;
  }

  /// The remaining work, for people, in passes of one photograph's rays through the grid. A grid that is one
  /// level finer has so many times more cells on a ray.
  std::size_t passes_to_do() const {
    const std::size_t count = all_.size();
    const auto left = [](std::size_t total, std::size_t done) { return total - std::min(total, done); };
    std::size_t passes = count;  // the hull
    if (!options_.cutoff && !found_.cutoff)
      passes += count * std::size_t(std::max(cutoff_estimate().iterations, 0));
    passes += count * left(std::size_t(std::max(options_.opacity.iterations, 0)),
                           found_.opacities ? found_.opacities->mean_change.size() : 0);
    if (!found_.colours) passes += count;  // the first colours
    passes += left(coarse_fit().steps(count), found_.colours ? found_.colours->state.steps : 0);
    return passes + std::size_t(options_.grid.branching) *
                        left(fine_fit().steps(count), found_.finer ? found_.finer->state.steps : 0);
  }

  /// `done`: how many of the step's parts were kept by earlier calls.
  void note(const std::string& step, const std::string& what, std::size_t done = 0) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - std::exchange(start_, now)).count();
    result_.times.push_back({step, seconds});
    result_.notes.push_back(fmt::format("{}: {:.1f} s{}", what, seconds,
                                        done > 0 ? fmt::format(", steps kept before: {}", done) : ""));
  }

  Status choose_cutoff(const CellGrid& grid, std::span<const TreeView> views) {
    Status status = Ok{};
    if (options_.cutoff || found_.cutoff) {
      result_.cutoff = options_.cutoff ? *options_.cutoff : *found_.cutoff;
    } else {
      OpacityOptions opacity = cutoff_estimate();
      opacity.after_iteration = [&](const Opacities&) {
        progress_.advance(all_.size());
        return true;
      };
      result_.cutoff = cutoff_by_held_out_error(grid, views, opacity);
      status = keeper_.keep(steps_.cutoff, true, [&] {
        std::string bytes;
        append_value(bytes, result_.cutoff);
        return bytes;
      });
    }
    note("cutoff", fmt::format("cutoff {}", result_.cutoff), !options_.cutoff && found_.cutoff ? 1 : 0);
    return status;
  }

  Status estimate(const CellGrid& grid, std::span<const TreeView> views, std::span<const Silhouette> masks) {
    Opacities start;
    if (found_.opacities && found_.opacities->extinction_per_m.size() == grid.size())
      start = *std::move(found_.opacities);
    const std::size_t done = start.mean_change.size();
    Status status = Ok{};
    OpacityOptions opacity = options_.opacity;
    opacity.processes = options_.processes;
    opacity.after_iteration = [&](const Opacities& now) {
      progress_.advance(all_.size());
      const bool is_finished = now.mean_change.size() == std::size_t(options_.opacity.iterations);
      status = keeper_.keep(steps_.opacity, is_finished, [&] { return bytes_of(now); });
      return status.ok();
    };
    result_.opacities = estimate_opacity(grid, views, masks, opacity, std::move(start));
    const std::vector<double>& change = result_.opacities.mean_change;
    note("opacity",
         fmt::format("opacity in {} iterations, mean change {:.4f} to {:.4f}", opacity.iterations,
                     change.empty() ? 0.0 : change.front(), change.empty() ? 0.0 : change.back()),
         done);
    return status;
  }

  Status fit_colours(CellGrid grid, std::span<const TreeView> views) {
    FitState state;
    if (found_.colours) {
      result_.volume = std::move(found_.colours->volume), state = std::move(found_.colours->state);
    } else {
      result_.volume =
          coloured(std::move(grid), result_.opacities.extinction_per_m, views, options_.processes);
      progress_.advance(all_.size());
    }
    const std::size_t done = state.steps;
    if (Status status = fit(coarse_fit(), {steps_.colours, 1, true}, views, state); !status) return status;
    result_.volume = without_transparent_cells(result_.volume, result_.cutoff);
    note("colours",
         fmt::format("colours, {} cells, RMS error {:.4f}", result_.volume.grid.size(),
                     state.errors.empty() ? 0.0 : state.errors.back()),
         done);
    return Ok{};
  }

  Status fit_finer(std::span<const TreeView> views) {
    FitState state;
    if (found_.finer) {
      result_.volume = std::move(found_.finer->volume), state = std::move(found_.finer->state);
    } else {
      Result<TreeVolume> fine = subdivided(result_.volume);
      if (!fine) return fine.errors();
      result_.volume = *std::move(fine);
    }
    const std::size_t done = state.steps;
    // Its end is the result, which the caller writes; kept, too, it would be as much again on the disk.
    const FitKeeping keeping{steps_.finer, std::size_t(options_.grid.branching), false};
    if (Status status = fit(fine_fit(), keeping, views, state); !status) return status;
    result_.volume = without_transparent_cells(result_.volume, result_.cutoff);
    note("finer",
         fmt::format("one level finer, {} cells, RMS error {:.4f}", result_.volume.grid.size(),
                     state.errors.back()),
         done);
    return Ok{};
  }

  /// How a fit is reported and kept.
  struct FitKeeping {
    const KeptStep& step;
    std::size_t passes;  // of progress, per step
    bool keeps_end;
  };

  /// Fits the volume of the result from `state` on.
  Status fit(FitOptions options, const FitKeeping& keeping, std::span<const TreeView> views,
             FitState& state) {
    Status status = Ok{};
    const std::size_t total = options.steps(views.size());
    options.after_step = [&](const FitState& now) {
      progress_.advance(keeping.passes);
      status = keeper_.keep(keeping.step, keeping.keeps_end && now.steps == total,
                            [&] { return bytes_of(result_.volume, now); });
      return status.ok();
    };
    fit_volume(result_.volume, views, options, state);
    return status;
  }

  std::span<const TreeView> all_;
  const ReconstructionOptions& options_;
  KeptSteps steps_;
  StepKeeper keeper_;
  Found found_;
  Progress progress_;
  Reconstruction result_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

Result<Reconstruction> reconstruct(std::span<const TreeView> views, const ReconstructionOptions& options) {
  if (views.size() < 3)
    return error("{} photographs of the tree: at least 3 are needed, 20 to 30 are recommended", views.size());
  return Work(views, options).run();
}

}  // namespace parvis::trees
