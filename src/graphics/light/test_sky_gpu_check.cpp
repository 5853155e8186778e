#include "graphics/light/test_sky_gpu_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "graphics/gl/program.h"
#include "graphics/light/preetham.h"
#include "graphics/light/sky_view.h"
#include "graphics/light/test_worse.h"

namespace parvis::light {
namespace {

constexpr int check_side = 96;

std::vector<glm::vec4> even_directions() {
  std::vector<glm::vec4> directions;
  for (int i = 0; i < check_side * check_side; ++i) {
    const float z = 1.0f - 2.0f * (float(i) + 0.5f) / float(check_side * check_side),
                turn = 2.39996323f * float(i);
    const float across = std::sqrt(1.0f - z * z);
    directions.emplace_back(across * std::cos(turn), across * std::sin(turn), z, 0.0f);
  }
  return directions;
}

gl::Texture table_texture(const SkyView& view, float added) {
  std::vector<glm::vec4> texels = view.texels();
  for (glm::vec4& texel : texels) texel += added;
  gl::Texture texture = gl::Texture::create(GLenum(GL_TEXTURE_2D_ARRAY));
  glTextureStorage3D(texture.name(), 1, GL_RGBA32F, SkyView::columns, SkyView::rows, 2);
  glTextureSubImage3D(texture.name(), 0, 0, 0, 0, SkyView::columns, SkyView::rows, 2, GL_RGBA, GL_FLOAT,
                      texels.data());
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  return texture;
}

std::vector<glm::vec4> drawn(const gl::Program& program) {
  const gl::Texture target = gl::texture_2d(GL_RGBA32F, check_side, check_side);
  const gl::Framebuffer framebuffer = gl::Framebuffer::create();
  const gl::VertexArray no_attributes = gl::VertexArray::create();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, target.name(), 0);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  glViewport(0, 0, check_side, check_side);
  glDisable(GL_BLEND), glDisable(GL_DEPTH_TEST), glDisable(GL_CULL_FACE);
  glBindVertexArray(no_attributes.name());
  program.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
  std::vector<glm::vec4> result(std::size_t(check_side) * check_side);
  glGetTextureImage(target.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(result.size() * sizeof(glm::vec4)),
                    result.data());
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return result;
}

void compare(const std::vector<glm::vec4>& gpu, const std::vector<glm::vec3>& cpu, SkyGpuCheck& check) {
  double mean = 0.0;
  for (const glm::vec3& value : cpu) mean += double(value.y) / double(cpu.size());
  for (std::size_t i = 0; i < cpu.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double a = double(gpu[i][c]), b = double(cpu[i][c]);
      check.samples += 2;
      check.bad_samples += (a >= 0.0 && std::isfinite(a) ? 0 : 1) + (b >= 0.0 && std::isfinite(b) ? 0 : 1);
      check.max_relative_error =
          worse(check.max_relative_error, std::abs(a - b) / std::max({b, mean, 1e-12}));
    }
}

}  // namespace

Result<SkyGpuCheck> check_sky_on_gpu(const Air& air, double sun_elevation_deg, float table_error) {
  Result<gl::Program> program =
      gl::Program::create("graphics/render/whole_screen.vert", "graphics/light/test_sky_check.frag");
  if (!program) return program.errors();
  const double elevation = sun_elevation_deg * 3.14159265358979 / 180.0;
  const glm::vec3 to_sun(-0.6 * std::cos(elevation), 0.8 * std::cos(elevation), std::sin(elevation));
  const SkyView view(Atmosphere(air), to_sun);

  const std::vector<glm::vec4> directions = even_directions();
  const gl::Texture input = gl::texture_2d(GL_RGBA32F, check_side, check_side),
                    table = table_texture(view, table_error);
  glTextureSubImage2D(input.name(), 0, 0, 0, check_side, check_side, GL_RGBA, GL_FLOAT, directions.data());
  glTextureParameteri(input.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glBindTextureUnit(0, input.name());
  glBindTextureUnit(1, table.name());
  program->set("directions", 0);
  program->set("sky_view_table", 1);
  program->set("to_sun", to_sun);

  SkyGpuCheck check;
  for (const float turbidity : {0.0f, float(air.turbidity)}) {
    program->set("turbidity", turbidity);
    std::vector<glm::vec3> cpu;
    for (const glm::vec4& direction : directions)
      cpu.push_back(turbidity > 0.0f ? preetham_radiance_xyz(glm::vec3(direction), to_sun, turbidity)
                                     : view.radiance_xyz(glm::vec3(direction)));
    compare(drawn(*program), cpu, check);
  }
  return check;
}

}  // namespace parvis::light
