// The tiles of leaf_detail.h of all captured trees, in one array texture.
#pragma once

#include <map>
#include <span>

#include "capture/trees/tree_levels.h"
#include "graphics/gl/objects.h"

namespace parvis::trees {

class DetailTiles {
 public:
  /// Uploads the trees' tiles. Needs a current OpenGL context.
  static DetailTiles of(std::span<const TreeLevels* const> trees);

  /// The layer of a tree; null: it has no detail.
  const std::uint32_t* layer(const TreeLevels* tree) const {
    const auto found = layers_.find(tree);
    return found == layers_.end() ? nullptr : &found->second;
  }
  /// The name of the array texture; 0 where no tree has detail.
  GLuint texture() const { return layers_.empty() ? 0 : texture_.name(); }

 private:
  std::map<const TreeLevels*, std::uint32_t> layers_;
  gl::Texture texture_;
};

}  // namespace parvis::trees
