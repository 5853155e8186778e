// The GPU's shading equals the C++ build of the same files.
#include <gtest/gtest.h>

#include <vector>

#include "graphics/gl/program.h"
#include "graphics/gl/test_context.h"
#include "graphics/shading/lighting.h"
#include "graphics/shading/sky_visibility.h"
#include "graphics/shading/tone_curve.h"

namespace parvis::shading {
#include "graphics/render/test_shading_check.glsl"
}  // namespace parvis::shading

namespace parvis::render {
namespace {

class ShadingCheck : public gl::ContextTest {};

TEST_F(ShadingCheck, TheGpuComputesWhatCppDoes) {
  constexpr int size = 64;
  Result<gl::Program> program =
      gl::Program::create("graphics/render/whole_screen.vert", "graphics/render/test_shading_check.frag");
  ASSERT_TRUE(program) << to_string(program.errors());
  const gl::Texture texture = gl::texture_2d(GL_RGBA32F, size, size);
  const gl::Framebuffer framebuffer = gl::Framebuffer::create();
  const gl::VertexArray no_attributes = gl::VertexArray::create();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, texture.name(), 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewport(0, 0, size, size);
  glBindVertexArray(no_attributes.name());
  program->use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<glm::vec4> result(std::size_t(size) * size);
  glGetTextureImage(texture.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(result.size() * sizeof(glm::vec4)),
                    result.data());

  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const glm::vec3 expected = shading::checked_shading(float(x), float(y));
      const glm::vec4 actual = result[std::size_t(y * size + x)];
      // Mesa approximates exp2, log2, acos and pow to about 1e-4.
      for (int c = 0; c < 3; ++c) ASSERT_NEAR(actual[c], expected[c], 1e-3f) << "case " << x << ", " << y;
    }
}

}  // namespace
}  // namespace parvis::render
