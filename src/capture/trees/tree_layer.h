// Many billboards are blended in a picture of one sample per pixel, and all of them together over the view.
// All samples of a pixel show the same of a billboard, so that this is what the view's own samples would
// show, but three quarters of the blending are saved, and what crowns hide is stopped by depth before it is
// shaded.
//
// Limit: the edge of an opaque thing before the trees is as coarse as one sample per pixel.
#pragma once

#include <glm/glm.hpp>

#include "base/result.h"
#include "capture/trees/crown_cover.h"
#include "graphics/gl/program.h"

namespace parvis::trees {

class TreeLayer {
 public:
  /// Needs a current OpenGL context. Fails only if a shader does.
  static Result<TreeLayer> create();

  /// Takes over what the billboards of a main view hide, when all have been added to `cover`.
  void prepare(CrownCover& cover);
  /// Runs in the view's blend pass: binds the layer, with the view's depth, in place of the view's target.
  void begin(const render::View& view);
  /// Blends the layer over the view, and binds the view's target again.
  void end(const render::View& view) const;

 private:
  TreeLayer(gl::Program hide, gl::Program show) : hide_(std::move(hide)), show_(std::move(show)) {}
  /// A window draws another size in each frame: textures grow and never shrink.
  void resize(glm::ivec2 size);
  void draw_whole(const gl::Program& program, GLuint shown) const;

  gl::Program hide_, show_;  // write the depths behind which all is hidden; show the layer
  gl::VertexArray no_attributes_ = gl::VertexArray::create();
  gl::Texture colour_, depth_, hiding_depths_;
  gl::Framebuffer framebuffer_;
  glm::ivec2 size_{0}, squares_{0};       // in use
  glm::ivec2 room_{0}, squares_room_{0};  // of the textures
  glm::ivec4 touched_{0};
};

}  // namespace parvis::trees
