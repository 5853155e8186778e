// How well a place shows what a photograph shows that is none of those it was made of, beside other methods
// on the same photographs and model.
#pragma once

#include <string>
#include <vector>

#include "capture/facades/drawn_facade.h"
#include "capture/facades/packed_facade.h"
#include "capture/facades/shown_colours.h"
#include "capture/photographs/photograph.h"

namespace parvis::facades {

/// 255 in the pixels where a view sees the model, else 0; a channel.
Image8 model_mask(const LayerModel& model, const View& view);

/// A picture of a facade, which is sRGB already, as bytes.
Image8 rgba8_of(const ImageF& srgb);

/// The photographs `used` as the layers of a place have them: balanced, with what is not in the model found
/// by colour. Photographs that the place has left out are none of them.
std::vector<PreparedPhoto> prepared_as_layers(const std::vector<photographs::Photograph>& used,
                                              const PlaceLayers& place);

/// The picture with those pixels alone that layers colour: proposed colours become transparent.
Image8 coloured_by_layers(Image8 shown, const std::vector<ColourSource>& sources);

/// A view as a method shows it.
struct MethodView {
  std::string method;  ///< "layers", or a baseline's name (baselines.h)
  Image8 picture;      ///< sRGB RGBA; alpha 0 where the method has no colour of photographs
};
/// Views by the layers, then by each baseline. `facade` is the place, packed.
std::vector<MethodView> views_of_methods(const PlaceLayers& place, const PackedFacade& facade,
                                         const std::vector<PreparedPhoto>& prepared, const View& view);

}  // namespace parvis::facades
