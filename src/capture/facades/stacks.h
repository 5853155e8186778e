// The distinct stacks of items behind the pixels of a view: what all passes of 3.4.1 look at.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "capture/facades/layer_model.h"
#include "capture/facades/view.h"

namespace parvis::facades {

inline constexpr std::uint32_t no_item = ~0u;

/// Items nearest first. An item stands several times in a stack whose pixel it covers several times.
using Stack = std::u32string;

/// The different orders in which a view's pixels are covered by items.
struct Stacks {
  std::vector<Stack> distinct;   ///< of items that are visible somewhere; none is empty; ascending
  std::vector<bool> is_visible;  ///< per item: first of all surfaces at a pixel
};

/// Rasterises the model. `item_of_triangle` gives each triangle's item in [0, item_count), or `no_item` where
/// it is in a layer already: such triangles hide nothing, but `was_in_layer` ones do not become visible
/// through them either.
Stacks distinct_stacks(const LayerModel& model, const View& view,
                       std::span<const std::uint32_t> item_of_triangle, std::uint32_t item_count);

/// Direct occlusion: hides[a] lists the items directly behind a in some stack, ascending; a itself where it
/// covers a pixel twice in a row.
std::vector<std::vector<std::uint32_t>> direct_occlusion(const std::vector<Stack>& stacks,
                                                         std::uint32_t item_count);

/// The strongly connected components of more than one item, and items that hide themselves: groups of which
/// no member can be the first. Each ascending.
std::vector<std::vector<std::uint32_t>> cycles(const std::vector<std::vector<std::uint32_t>>& hides);

}  // namespace parvis::facades
