// Textures as the GPU samples them: mipmaps averaged in linear light, trilinear lookups.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <mutex>
#include <vector>

#include "scene/data/model.h"

namespace parvis::reference {

class MipTexture {
 public:
  /// The same levels as the renderer's (scene/data/mip_levels.h), made when a smaller one is first looked
  /// into, by any thread: rays for shadows alone need none. The texture outlives this.
  MipTexture(const scene::Texture& texture, int visible_alpha);

  /// Linear colour (or data) and alpha at texture coordinates; `texels` is the width of what the ray sees, in
  /// texels of the finest level.
  glm::vec4 sample(glm::vec2 uv, float texels) const;
  /// The mean of the whole texture.
  glm::vec4 mean() const { return texel(level(level_count_ - 1), 0, 0); }
  glm::vec2 size() const { return {float(source_->image.width), float(source_->image.height)}; }

 private:
  const Image8& level(int number) const;
  glm::vec4 texel(const Image8& level, int x, int y) const;
  glm::vec4 bilinear(const Image8& level, glm::vec2 uv) const;

  struct Smaller {
    std::once_flag made;
    std::vector<Image8> levels;
  };

  const scene::Texture* source_;
  int visible_alpha_, level_count_;
  std::unique_ptr<Smaller> smaller_ = std::make_unique<Smaller>();
  const float* value_of_byte_;  ///< of colour channels
  scene::Wrap wrap_u_, wrap_v_;
};

}  // namespace parvis::reference
