// Visibility layers: groups of surfaces of which none hides another, sorted by visibility from a photograph
// (thesis 3.4.1, after Krishnan et al. 1996).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/facades/layer_model.h"
#include "capture/facades/stacks.h"
#include "capture/facades/view.h"

namespace parvis::facades {

/// An object, or one of its faces where the object had to be split.
struct LayerItem {
  std::uint32_t object = 0;
  std::int64_t face = -1;  ///< of the model; -1: the whole object
};

/// Items of a view in layers, each hidden only by items of earlier layers (section 3.4.1).
struct VisibilityLayers {
  std::vector<LayerItem> items;  ///< each with at least one visible pixel
  std::vector<std::vector<std::uint32_t>>
      layers;            ///< of items, ascending; nothing hides an item of the first layer, only
                         ///< items of earlier layers hide one of a later
  std::size_t cuts = 0;  ///< cuts of faces that the cycles of this view needed
  Errors warnings;
};

/// One visibility layer of `stacks` by the passes of 3.4.1: inverted depth test with counting until nothing
/// is counted twice, then the comparison with the first pass (figure 3.7). Empty where every item is hidden
/// somewhere by another.
std::vector<std::uint32_t> next_layer(const std::vector<Stack>& stacks, std::uint32_t item_count);

/// All layers of a view that sees the model as `name`. Where a layer is empty the remaining objects are split
/// into their faces; where that does not suffice, faces on cycles are split into triangles and these are cut
/// (newell_cut.h), in `model`. Items without a visible pixel are in no layer. A view that sees nothing of the
/// model has no layers and a warning.
VisibilityLayers visibility_layers(LayerModel& model, const View& view, const std::string& name);

/// The same for several views, each with the cuts of all: the model is final when this returns.
std::vector<VisibilityLayers> visibility_layers(LayerModel& model, const std::vector<View>& views,
                                                const std::vector<std::string>& names);

/// The item of each triangle of the model, or `no_item`.
std::vector<std::uint32_t> item_of_triangle(const LayerModel& model, const std::vector<LayerItem>& items);

}  // namespace parvis::facades
