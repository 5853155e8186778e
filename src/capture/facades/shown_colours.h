// Where the colours come from that views of a packed place show: whether any pixel is left without one.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "capture/facades/drawn_facade.h"
#include "capture/facades/packed_facade.h"

namespace parvis::facades {

/// The source of a pixel's colour.
enum class ColourSource : std::uint8_t {
  no_model,
  none,      ///< something of its colour is no_colour
  proposed,  ///< all of it is proposed for what no photograph shows (surface_colours.h)
  layers     ///< a photograph's layer gives it or a part of it: what was seen, or what was filled
};

/// Finds them by drawing, with the photographs that are chosen for each view.
class ShownColours {
 public:
  explicit ShownColours(const PackedFacade& facade);
  ShownColours(const ShownColours&) = delete;
  /// Sources of all pixels, row by row.
  std::vector<ColourSource> sources(const View& view);

 private:
  PackedFacade black_corners_, marked_corners_;
  DrawnFacade black_, marked_;
};

/// Small views from between the cameras, toward what one of them looks at; the same for the same cameras.
std::vector<View> random_views(std::span<const View> cameras, int count);

/// Shares of the model's pixels in some views, percent.
struct ShownShares {
  double filled_percent = 0.0;   ///< that have a colour: of layers, or a proposed one
  double layered_percent = 0.0;  ///< that have one of layers
};
/// All 0 where no view shows the model.
ShownShares shown_shares(const PackedFacade& facade, std::span<const View> views);

}  // namespace parvis::facades
