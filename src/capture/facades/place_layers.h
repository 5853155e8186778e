// All stages from calibrated photographs and a model to layers that are ready for display.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "capture/facades/fill.h"
#include "capture/facades/layered_photo.h"

namespace parvis::facades {

/// A place in layers: the model with its cuts, and for each photograph the layers of 3.4 and their pixels.
struct PlaceLayers {
  LayerModel model;
  std::vector<std::string> names;  ///< per photograph
  std::vector<View> views;
  std::vector<VisibilityLayers> visibility;
  std::vector<LayeredView> layered;
  std::vector<LayerPixels> originals;  ///< the photographs' own pixels
  std::vector<Balance> balances;
  std::vector<Filled> filled;
  Errors warnings;  ///< an entry per photograph that was left out, and those of visibility_layers

  LayersOfModel layers(std::size_t photo) const {
    return {model, views[photo], visibility[photo], layered[photo]};
  }
};

class LayerKeeper;

/// Which optional stages run.
struct PlaceSettings {
  bool balances_colours = true, finds_occluders = true, fills = true;
  bool flattens_shadows = false;  ///< see moved_shadows.h; only with balances_colours
};

/// Makes them. Photographs without pixels, of another size than their cameras, or with lens distortion are
/// left out, with a warning each. Fails where none is left or the model is invalid. A `keeper` gives what is
/// finished already, and keeps what is made; where it cannot, a warning says so.
Result<PlaceLayers> place_layers(const std::vector<photographs::Photograph>& photos,
                                 const std::vector<NamedMesh>& meshes, const PlaceSettings& settings = {},
                                 const LayerKeeper* keeper = nullptr);

/// The photographs as they are displayed, with the proposals that were not refused.
std::vector<LayeredPhoto> displayed(const PlaceLayers& place);

}  // namespace parvis::facades
