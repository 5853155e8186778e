#include "reflections/methods/lobe_filter.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "reflections/methods/lobe_levels.h"

namespace parvis::methods {
namespace {

constexpr int max_side =
    16;  // texels of a face that is blurred: 6 degrees each, half a lobe of roughness 0.2

}  // namespace

Result<LobeFilter> LobeFilter::create() {
  Result<gl::Program> program =
      gl::Program::create("graphics/render/whole_screen.vert", "reflections/methods/lobe_filter.frag");
  if (!program) return program.errors();
  program->set("cube", 0);
  return LobeFilter(*std::move(program));
}

LobeFilter::LobeFilter(gl::Program program)
    : program_(std::move(program)), picture_(gl::texture_2d(GL_RGBA16F, 6 * max_side, 2 * max_side)) {
  glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, picture_.name(), 0);
}

void LobeFilter::blur(GLuint cube, int resolution) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  program_.use();
  glBindTextureUnit(0, cube);
  glBindVertexArray(no_attributes_.name());
  const int level_count = int(std::bit_width(unsigned(resolution)));
  int first = 1;
  while ((resolution >> first) > max_side) ++first;
  const auto side_of = [&](int level) { return std::max(resolution >> level, 1); };
  for (int level = first, row = 0; level < level_count; row += side_of(level++)) {
    glViewport(0, row, 6 * side_of(level), side_of(level));
    program_.set("roughness", roughness_of_level(std::log2(float(resolution)), float(level)));
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  // Copied when all are drawn: what is blurred is made of the mipmaps.
  for (int level = first, row = 0; level < level_count; row += side_of(level++))
    for (int face = 0; face < 6; ++face)
      glCopyImageSubData(picture_.name(), GL_TEXTURE_2D, 0, face * side_of(level), row, 0, cube,
                         GL_TEXTURE_CUBE_MAP, level, 0, 0, face, side_of(level), side_of(level), 1);
}

}  // namespace parvis::methods
