// From photographs to a volume in one call: hull, grid, opacity, colours, one finer level. Interrupted, the
// same call goes on where it was.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "capture/trees/tree_volume.h"

namespace parvis::trees {

/// The steps' options.
struct ReconstructionOptions {
  GridOptions grid;             ///< of the opacity estimate
  OpacityOptions opacity;       ///< its own cutoff is not used: `cutoff` is
  std::optional<float> cutoff;  ///< transparency above which cells are dropped; none: by held-out error
  int coarse_epochs = 3;        ///< of the fit at the grid's level
  int fine_epochs = 4;          ///< of the fit at one level more; 0: there is none
  float fine_smoothing =
      0.3f;  ///< of that fit (FitOptions::smoothing): by held-out error, docs/experiments/tree-smoothing.md
  machines::Processes processes = {};     ///< that share the work (MPI)
  bool keeps_inconsistent = false;        ///< a photograph that contradicts all others; else it is left out
  std::filesystem::path checkpoint = {};  ///< folder for what is done, the caller's to remove; empty: none
  std::chrono::seconds keeping_interval{20};          ///< how much work a kill may cost
  const std::atomic<bool>* is_interrupted = nullptr;  ///< when it turns true, no further step is begun
};

/// How long a step took.
struct StepTime {
  std::string step;  ///< hull, cutoff, opacity, colours, finer
  double seconds = 0.0;
};

/// A reconstructed tree.
struct Reconstruction {
  TreeVolume volume;
  Opacities opacities;             ///< of the first estimate, with its convergence
  float cutoff = 1.0f;             ///< that was used
  std::vector<std::string> notes;  ///< per step: what was found, and seconds
  std::vector<StepTime> times;     ///< in their order
};

/// Reconstructs a tree. The same photographs and options give the same cells for any number of threads, of
/// any number of processes, with or without interruption. A photograph whose silhouette contradicts all
/// others is left out, and the notes name it. Errors: what hull_box and hull_grid say; the work was
/// interrupted, or what is done cannot be kept (what was kept before stays, and the same call goes on from
/// there).
Result<Reconstruction> reconstruct(std::span<const TreeView> views, const ReconstructionOptions& options);

}  // namespace parvis::trees
