// Pictures of what the stages do with one photograph, as the thesis shows it in chapter 3.
#pragma once

#include <cstddef>
#include <filesystem>

#include "base/image.h"
#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// Figure 3.2: the largest image layers of a photograph, front to back, a row each: on the left the pixels
/// that the photograph has of it, on the right with what was filled; a checkerboard shows where nothing is.
Image8 layers_figure(const PlaceLayers& place, std::size_t photo);

/// Figure 3.8: on the left the fullest visibility layer of a photograph as one texture, on the right the
/// image layers that it became, each framed by its texture with power-of-two sides.
Image8 merging_figure(const PlaceLayers& place, std::size_t photo);

/// Figure 3.3: a view of the place from aside, and on its right the same surfaces in the colours of the
/// layers that the photograph projects onto them: bright what the photograph sees, dark what was hidden in
/// it.
Image8 projection_figure(const PlaceLayers& place, const PackedFacade& facade, std::size_t photo);

/// Figure 3.14: above three photographs (the first, one of the middle, the last); below, in one common view,
/// the model's pixels that none of the three sees (red), that one sees or more (lighter); and beside it the
/// same for what their layers hold, filled parts included.
Image8 coverage_figure(const PlaceLayers& place);

/// Shares of the model's pixels in the common view of coverage_figure, percent.
struct Coverage {
  double seen_percent = 0.0, layered_percent = 0.0;
};
/// Coverage by the three photographs of coverage_figure, and by their layers.
Coverage coverage_of(const PlaceLayers& place);

/// The photograph with the most image layers: the one whose figures show most.
std::size_t richest_photograph(const PlaceLayers& place);

/// Writes figure_3_2.png, figure_3_3.png, figure_3_8.png and figure_3_14.png into `folder`.
Status write_figures(const std::filesystem::path& folder, const PlaceLayers& place,
                     const PackedFacade& facade, std::size_t photo);

}  // namespace parvis::facades
