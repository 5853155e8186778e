// The textures of captured trees in one array texture, all trees, levels and photographs together.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "base/result.h"
#include "capture/trees/tree_levels.h"
#include "graphics/gl/objects.h"

namespace parvis::trees {

/// What a billboard has in place of a texture that its photograph did not take.
inline constexpr std::uint32_t no_tile = 0xFFFFFFFFu;

/// Where the textures lie. A tile is its column and row (9 bits each, from bit 0, counted in 4 texels), its
/// layer (8 bits) and its side (5 bits, in 4 texels). Texels are linear light, premultiplied.
class TreeAtlas {
 public:
  /// Uploads the trees. Needs a current OpenGL context. Errors: more than the GPU's array textures hold.
  static Result<TreeAtlas> create(std::span<const TreeLevels* const> trees);

  /// Of a cell's texture in a photograph.
  std::uint32_t tile(const TreeLevels* tree, std::size_t level, std::size_t view, std::size_t cell) const;
  /// The name of the array texture.
  GLuint texture() const { return texture_.name(); }
  /// True if the tree's strips are in the atlas.
  bool holds(const TreeLevels* tree) const { return first_strips_.contains(tree); }

 private:
  std::map<const TreeLevels*, std::vector<std::vector<std::uint32_t>>> first_strips_;  // per level and view
  gl::Texture texture_;
};

}  // namespace parvis::trees
