// Relief behind a surface, as shading/relief.glsl has it, at a hit of a ray.
#pragma once

#include "graphics/reference/mip_texture.h"
#include "graphics/shading/texture_frame.h"

namespace parvis::reference {

/// Where a ray has met the relief of a surface; flat where it has none.
class Relief {
 public:
  Relief() = default;
  /// `depth_m` is that of the normal texture's alpha 0; the ray sees `texels` of it, `width_m` wide.
  Relief(const MipTexture& normal_texture, float texels, float depth_m, float width_m,
         const shading::TextureFrame& edges, glm::vec3 normal, glm::vec3 direction, glm::vec2 uv);

  bool is_flat() const { return texture_ == nullptr; }
  /// Where textures are looked up in place of the surface's own coordinates.
  glm::vec2 uv() const { return {hit_.x, hit_.y}; }
  /// Share of the light from a direction (a unit vector on the viewer's side) that comes in here.
  float light_from(glm::vec3 to_light) const;

 private:
  const MipTexture* texture_ = nullptr;
  float texels_ = 0.0f, depth_m_ = 0.0f;
  shading::TextureFrame edges_{};
  glm::vec3 normal_{0.0f, 0.0f, 1.0f};
  glm::vec3 hit_{0.0f};  ///< uv, depth
};

}  // namespace parvis::reference
