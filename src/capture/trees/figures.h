// The figures of chapter 4 of the thesis (003_d5b01da2d2f805f6) from a capture: what the grid, the opacities
// and the billboards look like on the way to a tree. `parvis tree figures` writes them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "capture/trees/billboard_textures.h"
#include "capture/trees/reconstruction.h"

namespace parvis::trees {

/// The cells of a grid from a camera: boxes with edges, as in figure 4.5.
ImageF render_cells(const CellGrid& grid, const Pinhole& camera);

/// Opacities of the cells of one level of height (0..1 of the grid's box), from above, x to the right and y
/// upward; black: opaque, as figure 4.9 has it.
Image8 opacity_slice(const CellGrid& grid, std::span<const float> extinction_per_m, float height);

/// Pictures of the same height beside each other, with a white line between them; rows below each other.
Image8 contact_sheet(const std::vector<std::vector<Image8>>& rows);

/// A curve of a chart.
struct Curve {
  std::string name;
  std::vector<double> values;  ///< of the iterations 1, 2, ...
};
/// Curves over the iterations as a chart, SVG, logarithmic upward (figure 4.8).
std::string convergence_chart(std::span<const Curve> curves);

/// Input of the figures.
struct FigureInput {
  std::span<const TreeView> views;     ///< the capture
  std::span<const TreeView> held_out;  ///< further views of the same tree, at least one
  int level = 3;                       ///< of the grid
};

/// Writes figure-4.5.png, figure-4.8.svg, figure-4.9.png, figure-4.10.png, figure-4.12.png and
/// figure-4.15.png into a folder, which is made. Returns one line per figure. Errors: as of `reconstruct`;
/// what the disk says.
Result<std::vector<std::string>> write_figures(const std::filesystem::path& folder, const FigureInput& input);

}  // namespace parvis::trees
