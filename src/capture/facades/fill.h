// Filling of what a photograph does not see of its layers: automatic, in three steps, each only where the one
// before had nothing; and reversible, layer by layer.
#pragma once

#include <span>
#include <vector>

#include "capture/facades/layer_edits.h"
#include "capture/facades/prepared_photo.h"

namespace parvis::facades {

/// The state of a filled layer.
enum class Filling : std::uint8_t { none, proposal, accepted, refused };
inline constexpr const char* filling_names[] = {"none", "proposal", "accepted", "refused"};  ///< in files

/// Where a filled pixel came from.
enum class FillSource : std::uint8_t { none, seen, photographs, patches, smooth, painted };

/// Layers of a photograph with proposed colours for the pixels that it does not see.
struct Filled {
  LayerPixels pixels;           ///< with the proposals
  std::vector<Image8> sources;  ///< per layer, of its box, 1 channel: FillSource
  std::vector<Filling> states;  ///< per layer: proposal where something was filled, none elsewhere
};

/// Which steps of filling may run.
struct FillSettings {
  bool from_photographs = true, by_patches = true;  ///< the last step, plain inpainting, always runs
  int rim = 1;  ///< pixels next to what hides a surface that mix both, and are filled, too
};

/// Proposes colours for the pixels of photograph `own` that its layers cover and do not show:
/// 1. from the other photographs through the geometry (best view first; photographs that do not trust the
/// pixel are left out, and
///    so are points about which the best contradict each other);
/// 2. for each plane by the best shift of what is known of it, in the plane's rectified space, where facades
/// repeat: after He
///    and Sun 2012, with the seam's difference spread out by a membrane (Farbman et al. 2009's limit);
/// 3. smoothly from the rim (Laplace's equation).
/// `photos` are balanced, with occluders found; `own` is one of them, of which the layers were made; `pixels`
/// the layers.
Filled filled_layers(const LayersOfModel& layers, std::span<const PreparedPhoto> photos, std::size_t own,
                     const LayerPixels& pixels, const FillSettings& settings = {});

/// The layers with the proposals that were not refused.
LayerPixels chosen_pixels(const Filled& filled, const LayerPixels& unfilled);

}  // namespace parvis::facades
