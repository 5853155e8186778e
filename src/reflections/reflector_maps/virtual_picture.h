// The picture of all virtual objects, as large as the main view: each pixel shows what the patch there
// mirrors.
#pragma once

#include "graphics/gl/objects.h"
#include "graphics/render/renderer.h"
#include "graphics/render/whole_screen.h"

namespace parvis::reflector_maps {

class VirtualPicture {
 public:
  /// Fails only if a shader does.
  static Result<VirtualPicture> create();
  /// Clears the picture, made as large as the main view, and gives the mirrored view to draw into it with,
  /// all that `vertices` show: RGBA16F, depth and stencil, multisampled.
  render::View begin(const render::Renderer& renderer, render::VirtualVertices& vertices);
  /// Clears the colour as if no patch were marked.
  void clear_colour() const;
  void clear_depth() const;
  /// Brings the samples together in `texture`, weighed for the renderer's exposure.
  void resolve(const render::Renderer& renderer) const;
  /// Coverage in alpha: of what is marked in the pixel.
  GLuint texture() const { return picture_.name(); }

 private:
  explicit VirtualPicture(gl::Program resolve) : resolve_(std::move(resolve)) {}
  void resize(int width, int height);

  int width_ = 0, height_ = 0;
  glm::ivec2 room_{0};  ///< of the textures, which never shrink
  gl::Program resolve_;
  render::WholeScreen screen_;
  gl::Texture samples_, depth_stencil_, picture_;
  gl::Framebuffer drawn_, resolved_;
};

}  // namespace parvis::reflector_maps
