// The picture of all virtual objects, as large as the main view: each pixel shows what the patch there
// mirrors.
#pragma once

#include "gl/objects.h"
#include "render/renderer.h"

namespace parvis::curved_reflectors {

class VirtualPicture {
 public:
  /// Clears the picture, made as large as the main view, and gives the mirrored view to draw into it with,
  /// all that `vertices` show: RGBA16F, depth and stencil, multisampled.
  render::View begin(const render::Renderer& renderer, render::VirtualVertices& vertices);
  void clear_depth() const;
  /// Brings the samples together in `texture`.
  void resolve() const;
  GLuint texture() const { return picture_.name(); }

 private:
  void resize(int width, int height);

  int width_ = 0, height_ = 0;
  glm::ivec2 room_{0};  ///< of the textures, which never shrink
  gl::Texture samples_, depth_stencil_, picture_;
  gl::Framebuffer drawn_, resolved_;
};

}  // namespace parvis::curved_reflectors
