// Blurs cube maps for the lobes of rough mirrors, as engines do.
#pragma once

#include "graphics/gl/objects.h"
#include "graphics/gl/program.h"

namespace parvis::methods {

class LobeFilter {
 public:
  /// Fails only if the shader does.
  static Result<LobeFilter> create();

  /// Blurs the small levels of a cube map (RGBA16F, texels per side of its faces) whose mipmaps are there:
  /// lobe_levels.glsl. In the large ones a texel is as wide as the lobe that its level stands for.
  void blur(GLuint cube, int resolution) const;

 private:
  explicit LobeFilter(gl::Program program);

  gl::Program program_;
  gl::Texture picture_;  ///< all levels that are blurred, one above the other, the faces side by side
  gl::Framebuffer framebuffer_ = gl::Framebuffer::create();
  gl::VertexArray no_attributes_ = gl::VertexArray::create();
};

}  // namespace parvis::methods
