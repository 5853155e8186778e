// The textures of captured trees in one array texture, all trees, levels and photographs together.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <vector>

#include "base/result.h"
#include "capture/trees/crown_cover.h"
#include "capture/trees/tree_levels.h"
#include "graphics/gl/objects.h"

namespace parvis::trees {

/// The number that stands in place of a texture that a billboard's photograph did not take.
inline constexpr std::uint32_t no_tile = 0xFFFFFFFFu;

/// Where the textures lie. A tile is its column and row (9 bits each, from bit 0, counted in 4 texels), its
/// layer (8 bits) and its side (6 bits, in 4 texels). Texels are linear light, premultiplied.
class TreeAtlas {
 public:
  /// Uploads the trees. Needs a current OpenGL context. Errors: more than the GPU's array textures hold.
  static Result<TreeAtlas> create(std::span<const TreeLevels* const> trees);

  /// The tile of a cell's texture in a photograph.
  std::uint32_t tile(const TreeLevels* tree, std::size_t level, std::size_t view, std::size_t cell) const;
  /// Where on its billboard (-1..1: low and high corner) that texture shows something at a mip level.
  glm::vec4 extent(const TreeLevels* tree, std::size_t level, std::size_t view, std::size_t cell,
                   float mip_level) const;
  /// How opaque the parts of that texture are; a texture that is not there: in the mean.
  OpacityMask mask(const TreeLevels* tree, std::size_t level, std::size_t view, std::size_t cell) const;
  /// The mip level that a texture is looked up at where a texel is so many pixels wide. Tiles have three:
  /// they are whole numbers of 4 texels wide.
  static float mip_level(float texel_pixels) {
    return std::clamp(std::round(-std::log2(texel_pixels)), 0.0f, float(mip_levels - 1));
  }
  /// The name of the array texture.
  GLuint texture() const { return texture_.name(); }
  /// True if the tree's strips are in the atlas.
  bool holds(const TreeLevels* tree) const { return levels_.contains(tree); }

 private:
  static constexpr int mip_levels = 3;

  struct Level {
    std::uint32_t first_strip = 0;
    std::vector<std::uint32_t> first_tiles;  // of each view, counted from there
    std::vector<glm::u8vec4> extents;        // of each tile, texels: low corner, high corner excluded
    int mask_side = 4;                       // OpacityMask
    std::vector<std::uint8_t> masks;         // of each tile
  };
  std::map<const TreeLevels*, std::vector<Level>> levels_;
  gl::Texture texture_;
};

}  // namespace parvis::trees
