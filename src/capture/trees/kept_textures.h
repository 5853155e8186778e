// Textures of photographs that were made before an interruption.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "base/kept_parts.h"
#include "capture/trees/billboard_textures.h"

namespace parvis::trees {

/// Kept textures of one volume with one set of options: a part for the side of the textures, and one for each
/// photograph.
class KeptTextures {
 public:
  /// The checkpoint outlives it.
  KeptTextures(const KeptParts& checkpoint, const TreeVolume& volume, const TextureOptions& options);

  /// The side that was chosen for these photographs.
  std::optional<int> find_side(std::span<const TreeView> views) const;
  Status keep_side(std::span<const TreeView> views, int side) const;

  /// The textures of photograph `index`, for the cells and the side of `tree`.
  std::optional<BillboardTextures> find(std::size_t index, const TreeView& view,
                                        const BillboardTree& tree) const;
  /// Keeps those that the tree has of it. Any thread may.
  Status keep(std::size_t index, const TreeView& view, const BillboardTree& tree) const;

 private:
  const KeptParts& checkpoint_;
  std::uint64_t key_ = 0;  // of the volume and the options
};

}  // namespace parvis::trees
