#include "graphics/display/room_overlay.h"

namespace parvis::display {

std::optional<glm::dvec2> RoomPanel::hit(glm::dvec3 from, glm::dvec3 direction) const {
  const glm::dvec3 normal = glm::cross(right, up);
  const double towards = glm::dot(direction, normal);
  if (std::abs(towards) < 1e-9 * glm::length(normal)) return std::nullopt;
  const double along = glm::dot(lower_left - from, normal) / towards;
  const glm::dvec3 at = from + along * direction - lower_left;
  const glm::dvec2 share(glm::dot(at, right) / glm::dot(right, right), glm::dot(at, up) / glm::dot(up, up));
  if (along < 0.0 || share.x < 0.0 || share.x > 1.0 || share.y < 0.0 || share.y > 1.0) return std::nullopt;
  return glm::dvec2(share.x, 1.0 - share.y);
}

Result<RoomOverlay> RoomOverlay::create() {
  Result<gl::Program> program =
      gl::Program::create("graphics/display/room_panel.vert", "graphics/display/room_panel.frag");
  if (!program) return program.errors();
  program->set("panel_texture", 0);
  return RoomOverlay(*std::move(program));
}

void RoomOverlay::draw(const WallPicture& picture, GLuint framebuffer, const RoomPanel& panel,
                       glm::vec4 colour) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, picture.size.x, picture.size.y);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  program_.set("clip_from_room", picture.clip_from_room);
  program_.set("lower_left", glm::vec3(panel.lower_left));
  program_.set("right", glm::vec3(panel.right));
  program_.set("up", glm::vec3(panel.up));
  program_.set("colour_and_texture", colour);
  program_.use();
  glBindVertexArray(no_attributes_.name());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glDisable(GL_BLEND);
}

void RoomOverlay::draw_panel(const WallPicture& picture, GLuint framebuffer, const RoomPanel& panel,
                             GLuint texture) const {
  glBindTextureUnit(0, texture);
  draw(picture, framebuffer, panel, glm::vec4(0.0f));
}

void RoomOverlay::draw_rod(const WallPicture& picture, GLuint framebuffer, glm::dvec3 eye, glm::dvec3 from,
                           glm::dvec3 to, glm::vec3 colour) const {
  constexpr double thickness_m = 0.006;
  const glm::dvec3 across = glm::cross(to - from, 0.5 * (from + to) - eye);
  if (!(glm::length(across) > 1e-9)) return;  // the rod points at the eye
  const glm::dvec3 side = thickness_m * glm::normalize(across);
  draw(picture, framebuffer, {from - 0.5 * side, side, to - from}, {colour, 1.0f});
}

}  // namespace parvis::display
