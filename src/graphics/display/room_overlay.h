// Things of the room itself, drawn over the pictures of its eyes: the panel, the rod of a wand.
#pragma once

#include "graphics/display/frusta.h"
#include "graphics/gl/program.h"

namespace parvis::display {

/// A rectangle in the room, metres.
struct RoomPanel {
  glm::dvec3 lower_left{0.0}, right{1.0, 0.0, 0.0}, up{0.0, 0.0, 1.0};  ///< the whole width and height

  /// Where a ray from `from` meets it: shares of width and height from its upper left; nothing: beside it.
  std::optional<glm::dvec2> hit(glm::dvec3 from, glm::dvec3 direction) const;
};

/// Needs a current OpenGL context for as long as it lives.
class RoomOverlay {
 public:
  /// Fails only if a shader does.
  static Result<RoomOverlay> create();

  /// Draws a texture on a panel into the framebuffer of an eye's picture. Alpha counts, multiplied into the
  /// colours already.
  void draw_panel(const WallPicture& picture, GLuint framebuffer, const RoomPanel& panel,
                  GLuint texture) const;
  /// Draws a rod of one colour, a few millimetres thick, that turns its side to the eye at `eye`.
  void draw_rod(const WallPicture& picture, GLuint framebuffer, glm::dvec3 eye, glm::dvec3 from,
                glm::dvec3 to, glm::vec3 colour) const;

 private:
  explicit RoomOverlay(gl::Program program) : program_(std::move(program)) {}
  void draw(const WallPicture& picture, GLuint framebuffer, const RoomPanel& panel, glm::vec4 colour) const;

  gl::Program program_;
  gl::VertexArray no_attributes_ = gl::VertexArray::create();
};

}  // namespace parvis::display
