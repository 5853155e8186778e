// The tiles of a photograph's layers: those that are needed, in as few slots as hold them.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "capture/facades/layer_picture.h"

namespace parvis::facades {

/// A slot's texels while layers are put into it.
struct OpenSlot {
  Image8 texels{tile_side, tile_side, 4};
  std::vector<char> is_own = std::vector<char>(std::size_t(tile_side) * tile_side, 0), is_covered = is_own;
  glm::ivec2 cell{0};  ///< of the photograph's grid of tiles
  bool has_artists_alpha = false;

  /// Adds a layer's tile, unless they want the same texel.
  bool take(const OpenSlot& other);
};

/// The compressed blocks of a slot, of all its mipmaps, the finest first. Leaves the slot's texels changed.
std::vector<Bc7Block> blocks_of(OpenSlot& slot);

/// The needed tiles of a photograph's layers; layers that do not overlap share them.
class PhotoTiles {
 public:
  /// Adds a layer's tiles to `facade`, whose slots so far are `first_slot`.
  void add(const LayerPicture& picture, const PackedLayer& layer, std::size_t first_slot,
           PackedFacade& facade);
  /// All slots so far, as they are being filled.
  std::vector<OpenSlot>& slots() { return slots_; }

 private:
  /// An artist's alpha belongs to one layer alone.
  std::size_t place(OpenSlot tile, TileKind kind);

  std::vector<OpenSlot> slots_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> slots_of_cell_;
};

}  // namespace parvis::facades
