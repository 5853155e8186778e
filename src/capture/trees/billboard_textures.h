// Textures of a tree's billboards, one per cell and photograph (003_d5b01da2d2f805f6, section 4.5.3).
#pragma once

#include <optional>
#include <span>

#include "base/kept_parts.h"
#include "base/result.h"
#include "capture/trees/billboard_tree.h"

namespace parvis::trees {

/// How textures are made.
enum class TextureMethod : std::uint8_t {
  /// The default: texels start as what the volume shows within the cell, and are fitted to the photograph
  /// through over.
  optimised,
  /// The thesis: the floor(alpha M^2) texels of greatest age, then importance (equation 4.18), front to back.
  age_importance,
  /// Baseline of figure 4.10: every billboard shows the photograph behind it.
  naive,
  /// Baseline that the thesis tried first: floor(alpha M^2) texels at random.
  random_texels,
};

inline constexpr int max_chosen_side = 16;  ///< texels: what `textured` chooses at most

/// Options of `textured`.
struct TextureOptions {
  TextureMethod method = TextureMethod::optimised;
  /// M, a multiple of 4; 0 (the default of `textured`): as fine as the photographs' pixels, at most
  /// max_chosen_side, and coarser until the textures' blocks stay below `max_megabytes`.
  int texels_per_side = 0;
  float max_megabytes = 6.0f;  ///< of all textures in blocks, one byte per texel
  int iterations = 10;         ///< of `optimised`
  int parent_levels = 1;   ///< billboards stand for cells that are so many levels coarser than the volume's
  std::uint64_t seed = 1;  ///< of `random_texels`
  std::optional<glm::vec3> to_sun = std::nullopt;  ///< of the photographs; none: estimated
};

/// The billboards of a volume with their textures from the photographs.
BillboardTree textured(const TreeVolume& volume, std::span<const TreeView> views,
                       const TextureOptions& options);

/// The same, with progress. The textures of each photograph are kept when they are made, and found again by
/// the same call: `checkpoint` is the caller's to remove. Error: they cannot be kept; those that were stay.
Result<BillboardTree> textured(const TreeVolume& volume, std::span<const TreeView> views,
                               const TextureOptions& options, const KeptParts& checkpoint);

/// The textures of one photograph by 4.5.3, or by one of its two baselines. `texels_per_side` is given.
BillboardTextures selected_texels(const BillboardTree& tree, const TreeView& view,
                                  const TextureOptions& options);

/// The textures of one photograph by optimisation. `volume` is finer than or equal to the tree's grid;
/// `texels_per_side` is given.
BillboardTextures optimised_texels(const BillboardTree& tree, const TreeVolume& volume, const TreeView& view,
                                   const TextureOptions& options);

}  // namespace parvis::trees
