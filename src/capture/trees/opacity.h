// Opacity of a grid's cells from the mattes of calibrated photographs (003_d5b01da2d2f805f6, section 4.5.2).
//
// A cell holds an extinction coefficient tau (1/m); a ray that passes l metres of it keeps exp(-tau l). The
// thesis's transparency of a cell is t = exp(-tau s), s the cell's mean chord (its methods do not know
// lengths within a cell).
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "capture/trees/cell_grid.h"
#include "capture/trees/visual_hull.h"
#include "machines/processes.h"

namespace parvis::trees {

enum class OpacityMethod : std::uint8_t {
  /// The thesis: projection of log t onto the pixel's plane, weights V/V_c, averaged over the rays (equations
  /// 4.12-4.17). As printed a projected t' may exceed 1: see OpacityOptions::clamps.
  projection,
  /// Simultaneous iterative reconstruction in the logarithm with exact chord lengths (Gilbert 1972).
  sirt,
  /// The default: tau_j <- tau_j sum_i(l_ij a_i T_i / (1 - T_i)...) in alpha itself, non-negative, no
  /// logarithm of 0:
  /// tau_j <- tau_j * min(4, sum_i(l_ij a_i T_i) / sum_i(l_ij (1 - T_i) T_i)), T_i = exp(-sum_j tau_j l_ij).
  multiplicative,
};

/// The result of an estimate, or how far it is: one that was ended early goes on from here.
struct Opacities {
  std::vector<float> extinction_per_m;  ///< per cell of the grid
  std::vector<double> mean_change;      ///< per iteration: mean |change of t| over the cells (figure 4.8)
  int picture_factor = 1;               ///< that was used
};

/// How opacities are estimated.
struct OpacityOptions {
  OpacityMethod method = OpacityMethod::multiplicative;
  int iterations = 20;
  bool clamps = true;  ///< `projection` only: t' <= 1; false: as the thesis prints it
  std::optional<float>
      cutoff;              ///< transparency t above which a cell becomes empty after each iteration (4.5.2)
  int picture_factor = 0;  ///< mattes are reduced so many times; 0: until a pixel is about half a cell
  machines::Processes processes = {};  ///< each takes its share of the photographs
  /// Called after each iteration; where it returns false the estimate ends.
  std::function<bool(const Opacities&)> after_iteration = {};
};

/// The mean length of a cell's chords: 4 V / S (Cauchy), metres.
float mean_chord_m(glm::vec3 cell_size_m);

/// The thesis's start: the minimum over the views of the mean alpha of the cell's projection.
std::vector<float> initial_extinction(const CellGrid& grid, std::span<const Silhouette> silhouettes);

/// Estimates the cells' extinction. Every pixel of every view casts one ray. `start`: an estimate of the same
/// grid, views and options that goes on after its iterations; one without cells begins.
Opacities estimate_opacity(const CellGrid& grid, std::span<const TreeView> views,
                           std::span<const Silhouette> silhouettes, const OpacityOptions& options,
                           Opacities start = {});

/// The picture of alpha, 0..1, that a camera sees of the cells.
ImageF render_alpha(const CellGrid& grid, std::span<const float> extinction_per_m, const Pinhole& camera);

/// Root mean square difference of alpha over the pixels of all views, at the views' sizes divided by
/// `factor`.
double alpha_rmse(const CellGrid& grid, std::span<const float> extinction_per_m,
                  std::span<const TreeView> views, int factor);

/// The cutoff whose opacities show held-out views best: every fifth view is left out of an estimate, whose
/// cells are then cut off at each of the thesis's thresholds (and 1: none).
float cutoff_by_held_out_error(const CellGrid& grid, std::span<const TreeView> views, OpacityOptions options);

}  // namespace parvis::trees
