// Textures as the GPU samples them: mipmaps averaged in linear light, trilinear lookups.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/data/model.h"

namespace parvis::reference {

class MipTexture {
 public:
  /// The same levels as the renderer's (scene/data/mip_levels.h).
  MipTexture(const scene::Texture& texture, int visible_alpha);

  /// Linear colour (or data) and alpha at texture coordinates; `texels` is the width of what the ray sees, in
  /// texels of the finest level.
  glm::vec4 sample(glm::vec2 uv, float texels) const;
  /// The mean of the whole texture.
  glm::vec4 mean() const { return texel(levels_.back(), 0, 0); }
  glm::vec2 size() const { return {float(levels_.front().width), float(levels_.front().height)}; }

 private:
  glm::vec4 texel(const Image8& level, int x, int y) const;
  glm::vec4 bilinear(const Image8& level, glm::vec2 uv) const;

  std::vector<Image8> levels_;
  const float* value_of_byte_;  ///< of colour channels
  scene::Wrap wrap_u_, wrap_v_;
};

}  // namespace parvis::reference
