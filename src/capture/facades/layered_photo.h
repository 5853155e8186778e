// A photograph in layers as it is displayed: every surface looks up its own layer, hidden parts included.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "capture/facades/balance.h"
#include "capture/facades/layer_atlas.h"
#include "capture/facades/layer_edits.h"
#include "capture/facades/novel_view.h"

namespace parvis::facades {

struct LayeredPhoto {
  std::string name;
  View view;
  std::vector<std::uint32_t> layer_of_triangle;  ///< no_item: the photograph does not see the triangle's item
  std::vector<PixelBox> boxes;                   ///< per layer
  LayerAtlas atlas;
  Balance balance;  ///< applied where photographs are blended; the layers keep the photograph's own colours
};

/// Packs the layers of one photograph for display. `pixels` has an entry per layer.
LayeredPhoto layered_photo(const std::string& name, const LayersOfModel& layers, const LayerPixels& pixels);

/// Confidence in pixels that were filled or painted, over those that the photograph saw: they count where
/// nothing else does.
inline constexpr float filled_confidence = 0.01f;

/// What the photographs' layers say about a point of a triangle, best first. No depth maps: the layers have
/// resolved visibility. Colours are linear; `Opinion::confidence` includes the layer's alpha (an alpha map of
/// an artist).
std::vector<Opinion> opinions(std::span<const LayeredPhoto> photos, const BlendSettings& settings,
                              std::uint32_t triangle, glm::dvec3 point, glm::dvec3 eye, double pixel_size);

/// What `view` sees of the model through the layers: linear RGBA, alpha 0 where there is nothing.
ImageF novel_view(const LayerModel& model, const View& view, std::span<const LayeredPhoto> photos,
                  const BlendSettings& settings);

/// Takes what hides the model in a photograph, and is no part of it (trust below one half), for not seen: it
/// is to be filled.
void distrust(const ImageF& trust, LayeredView& layered);

/// A photograph's own viewpoint: plainly its layers, nothing blended (3.6).
ImageF own_view(const LayerModel& model, const LayeredPhoto& photo);

}  // namespace parvis::facades
