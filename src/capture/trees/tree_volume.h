// A tree as a volume: extinction and colour per cell, fitted to the photographs through the over operator.
//
// The thesis estimates opacity alone and leaves colour to the textures (003_d5b01da2d2f805f6, section 4.5.2):
// alpha gives little more than a soft hull. Fitting colours with it (equation 4.1 as the model of a pixel,
// gradient descent by Adam, Kingma and Ba 2015) finds which of the cells along a ray are seen, which is what
// the textures need to know.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "capture/trees/opacity.h"

namespace parvis::trees {

/// Extinction and colour of a grid's cells.
struct TreeVolume {
  CellGrid grid;
  std::vector<float> extinction_per_m;  ///< per cell
  std::vector<glm::vec3> colour;        ///< per cell, linear light, 0..1

  /// Opacity of a cell along its mean chord, 0..1: the thesis's alpha of the cell.
  float alpha(std::size_t cell) const;
};

/// How far a fit is: with the volume as it is then, all that it goes on from.
struct FitState {
  std::size_t steps = 0;                    ///< that are done, of all passes
  std::vector<double> errors;               ///< of each pass that is done, as fit_volume returns them
  double error_sum = 0.0, value_sum = 0.0;  ///< of the present pass: squared errors of pixels; their values
  std::vector<glm::vec4> mean,
      mean_square;                        ///< per cell: Adam's moments of the gradients; empty: no step yet
  std::vector<std::uint16_t> cell_steps;  ///< per cell: how often it was moved
};

/// How the volume is fitted.
struct FitOptions {
  int epochs = 10;                     ///< passes over all photographs
  float colour_rate = 0.04f;           ///< Adam's step, of the square root of the light
  float extinction_rate = 0.12f;       ///< Adam's step, of the logarithm of the extinction
  float smoothing = 0.0f;              ///< after each pass: share of the neighbours' mean in each cell
  int picture_factor = 1;              ///< photographs are reduced so many times
  std::uint64_t seed = 1;              ///< of the photographs' order
  machines::Processes processes = {};  ///< each holds its share of the rows and casts their rays
  /// Called after each step, when the volume and the state belong together; where it returns false the fit
  /// ends.
  std::function<bool(const FitState&)> after_step = {};

  /// How many steps a fit to so many photographs has.
  std::size_t steps(std::size_t photographs) const { return std::size_t(std::max(epochs, 0)) * photographs; }
};

/// Colours of an opacity estimate: for each cell the mean of the photographs' foreground, weighed by how much
/// of it each pixel sees. Several processes each take their share of the photographs.
TreeVolume coloured(CellGrid grid, std::vector<float> extinction_per_m, std::span<const TreeView> views,
                    const machines::Processes& processes = {});

/// Improves extinction and colours together. Returns the root mean square error over RGBA of each epoch, as a
/// display shows it: colours by the slope of sRGB.
std::vector<double> fit_volume(TreeVolume& volume, std::span<const TreeView> views,
                               const FitOptions& options);
/// The same from `state` on, which is of this volume, the same views and options. The result does not depend
/// on where a fit was ended and went on.
void fit_volume(TreeVolume& volume, std::span<const TreeView> views, const FitOptions& options,
                FitState& state);

/// The volume without the cells whose transparency is above `cutoff` (the thesis's threshold, 0.94 for its
/// oak).
TreeVolume without_transparent_cells(const TreeVolume& volume, float cutoff);

/// The volume with every cell divided once more; the parts inherit what the whole had. Errors: a side above
/// max_grid_side.
Result<TreeVolume> subdivided(const TreeVolume& volume);

/// The volume's picture by a camera: RGBA, premultiplied, linear light.
ImageF render_volume(const TreeVolume& volume, const Pinhole& camera);

}  // namespace parvis::trees
