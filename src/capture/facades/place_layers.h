// All stages from calibrated photographs and a model to layers that are ready for display.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "capture/facades/balance.h"
#include "capture/facades/fill.h"

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
  /// The state, per object of the model, of the colours proposed for parts that no photograph shows, the last
  /// step of filling (surface_colours.h).
  std::vector<Filling> surfaces;
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
  bool carries_edits = false;  ///< paints edits into the other photographs that show the place (make_place)
};

/// Makes them. Photographs without pixels, of another size than their cameras, or with lens distortion are
/// left out, with a warning each. Fails where none is left, none sees the model, or the model is invalid. A
/// `keeper` gives what is finished already, and keeps what is made; where it cannot, a warning says so.
Result<PlaceLayers> place_layers(const std::vector<photographs::Photograph>& photos,
                                 const std::vector<NamedMesh>& meshes, const PlaceSettings& settings = {},
                                 const LayerKeeper* keeper = nullptr);

}  // namespace parvis::facades
