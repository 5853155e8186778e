// The picture of all virtual objects, as large as the main view: each pixel shows what the patch there
// mirrors.
#pragma once

#include "gl/objects.h"

namespace parvis::curved_reflectors {

class VirtualPicture {
 public:
  void resize(int width, int height);
  /// To draw into: RGBA16F, depth and stencil, multisampled.
  GLuint framebuffer() const { return drawn_.name(); }
  void clear() const;
  void clear_depth() const;
  /// Brings the samples together in `texture`.
  void resolve() const;
  GLuint texture() const { return picture_.name(); }

 private:
  int width_ = 0, height_ = 0;
  gl::Texture samples_, depth_stencil_, picture_;
  gl::Framebuffer drawn_, resolved_;
};

}  // namespace parvis::curved_reflectors
