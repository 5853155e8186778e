#include "capture/trees/tree_layer.h"

#include "graphics/gl/sampled_textures.h"
#include "graphics/render/bindings.h"

namespace parvis::trees {

Result<TreeLayer> TreeLayer::create() {
  const char* whole_screen = "graphics/render/whole_screen.vert";
  Result<gl::Program> hide = gl::Program::create(whole_screen, "capture/trees/hiding_depth.frag");
  if (!hide) return hide.errors();
  Result<gl::Program> show = gl::Program::create(whole_screen, "capture/trees/tree_layer.frag");
  if (!show) return show.errors();
  return TreeLayer(*std::move(hide), *std::move(show));
}

void TreeLayer::resize(glm::ivec2 size) {
  size_ = size;
  if (glm::all(glm::lessThanEqual(size, room_))) return;
  room_ = glm::max(size, room_);
  colour_ = gl::texture_2d(GL_RGBA16F, room_.x, room_.y);
  depth_ = gl::texture_2d(GL_DEPTH_COMPONENT32F, room_.x, room_.y);
  framebuffer_ = gl::Framebuffer::create();
  glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, colour_.name(), 0);
  glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
}

void TreeLayer::prepare(CrownCover& cover) {
  squares_ = cover.squares();
  if (glm::any(glm::greaterThan(squares_, squares_room_))) {
    squares_room_ = glm::max(squares_, squares_room_);
    hiding_depths_ = gl::texture_2d(GL_R32F, squares_room_.x, squares_room_.y);
  }
  touched_ = cover.touched();
  glTextureSubImage2D(hiding_depths_.name(), 0, 0, 0, squares_.x, squares_.y, GL_RED, GL_FLOAT,
                      cover.hiding_depths().data());
}

void TreeLayer::draw_whole(const gl::Program& program, GLuint shown) const {
  program.use();
  gl::bind_textures(program, {{"shown", render::first_drawable_unit, shown}});
  glBindVertexArray(no_attributes_.name());
  glDisable(GL_CULL_FACE);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void TreeLayer::begin(const render::View& view) {
  resize({view.width, view.height});
  // Nothing is to be done where no billboard is.
  const glm::vec2 square_pixels = glm::vec2(size_) / glm::vec2(squares_);
  glm::ivec2 low(glm::floor(square_pixels * glm::vec2(touched_.x, touched_.y))),
      high(glm::ceil(square_pixels * glm::vec2(touched_.z, touched_.w)));
  if (view.has_part()) {
    const glm::ivec2 part(view.part.x, view.part.y);
    low = glm::max(low, part), high = glm::min(high, part + glm::ivec2(view.part.z, view.part.w));
  }
  const glm::ivec2 size = glm::max(high - low, 0);
  glEnable(GL_SCISSOR_TEST);
  glScissor(low.x, low.y, size.x, size.y);

  glBlitNamedFramebuffer(view.framebuffer, framebuffer_.name(), 0, 0, size_.x, size_.y, 0, 0, size_.x,
                         size_.y, GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  constexpr GLfloat nothing[4]{};
  glClearBufferfv(GL_COLOR, 0, nothing);
  glDisable(GL_BLEND);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDepthMask(GL_TRUE);
  hide_.set("squares_per_pixel", 1.0f / square_pixels);
  draw_whole(hide_, hiding_depths_.name());
  glDepthMask(GL_FALSE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glEnable(GL_BLEND);
}

void TreeLayer::end(const render::View& view) const {
  glBindFramebuffer(GL_FRAMEBUFFER, view.framebuffer);
  glDisable(GL_DEPTH_TEST);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // the layer is premultiplied
  draw_whole(show_, colour_.name());
  // As the renderer's blend pass has it.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glEnable(GL_DEPTH_TEST);
  if (view.has_part())
    glScissor(view.part.x, view.part.y, view.part.z, view.part.w);
  else
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace parvis::trees
