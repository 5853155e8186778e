// Makes one picture of another: a program of render/whole_screen.vert run for every pixel.
#pragma once

#include <glm/vec2.hpp>

#include "graphics/gl/program.h"

namespace parvis::render {

class WholeScreen {
 public:
  /// Fills the first `size` pixels of a framebuffer; the program finds `texture` at unit 0.
  void draw(const gl::Program& program, GLuint framebuffer, glm::ivec2 size, GLuint texture) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    program.use();
    glBindTextureUnit(0, texture);
    glBindVertexArray(no_attributes_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

 private:
  gl::VertexArray no_attributes_ = gl::VertexArray::create();
};

}  // namespace parvis::render
