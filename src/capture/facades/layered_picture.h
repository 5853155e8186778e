// A photograph's image layers as a layered picture for an image editor, and back.
#pragma once

#include <string>
#include <vector>

#include "base/image.h"
#include "capture/facades/image_layers.h"
#include "capture/facades/psd.h"

namespace parvis::facades {

/// Names of the two layers that are no image layers.
inline constexpr const char* photograph_layer_name = "photograph";
inline constexpr const char* depth_layer_name = "depth";

/// RGBA of every layer's box, in the order of LayeredView::layers: what is edited. Alpha 255 where an item
/// covers the pixel, unless an artist made it see-through; 0 elsewhere.
using LayerPixels = std::vector<Image8>;

/// The photograph's own pixels in every layer: what hides a layer still shows in it.
LayerPixels original_pixels(const Image8& photograph, const LayeredView& layered);

/// One true layer for each image layer, the nearest on top, with its name, its box, its pixels, and a
/// disabled layer mask that is white where the photograph sees the surface ("mask to selection" selects what
/// is to be filled once inverted). Below all lies the photograph; above all a hidden layer "depth", white
/// near and black far (linear in 1 / depth), for depth-aware editing.
PsdPicture layered_picture(const Image8& photograph, const LayeredView& layered, const LayerPixels& pixels,
                           const std::vector<float>& depths);

/// The layers that were written, as an edited picture holds them.
struct ReadLayers {
  LayerPixels pixels;           ///< of every image layer; as written where the picture lacks it
  std::vector<bool> was_found;  ///< per image layer
  Errors messages;  ///< an entry for each layer that was renamed, deleted, merged, resized, hidden, that is
                    ///< blended, clipped or in a masked group, and for 16 bits
};

/// Matches the layers of an edited picture with those written: by name, and where a name is gone, by their
/// boxes. Order does not matter. Opacity and masks are read, with those of groups; hidden layers stay as they
/// were written. Fails only where the picture as a whole was resized.
Result<ReadLayers> read_layers(const PsdPicture& edited, const LayeredView& layered,
                               const LayerPixels& written, int width, int height, const std::string& name);

}  // namespace parvis::facades
