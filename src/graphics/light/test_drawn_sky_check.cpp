#include "graphics/light/test_drawn_sky_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "graphics/light/day_light.h"
#include "graphics/light/spectrum.h"
#include "graphics/light/sun_and_sky.h"
#include "graphics/light/test_worse.h"
#include "graphics/reference/camera_ray.h"
#include "graphics/render/renderer.h"

namespace parvis::light {

Camera view_of_sky(int face) {
  glm::vec3 ahead(0.0f);
  ahead[face / 2] = face % 2 ? 1.0f : -1.0f;
  Camera camera;
  camera.world_from_camera =
      look_at(glm::vec3(0.0f), ahead, face / 2 == 2 ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1));
  camera.vertical_fov = 1.5707963f;
  return camera;
}

Result<DrawnSkyError> drawn_sky_error(SkyKind kind, double turbidity, double elevation_deg,
                                      float turned_deg) {
  constexpr int size = 128;
  const auto sky = make_sky(kind, Air{turbidity},
                            SolarPosition{.azimuth_deg = 180.0,
                                          .zenith_deg = 90.0 - elevation_deg,
                                          .geometric_elevation_deg = elevation_deg});
  if (!sky) return sky.errors();
  scene::Scene scene;
  scene.sun = {(*sky)->to_sun(), glm::vec3(1.0f)};
  scene.sky.picture = sky_picture(**sky, {}, 512);
  auto renderer = render::Renderer::create(scene, {}, sun_and_sky);
  if (!renderer) return renderer.errors();
  shading::SkyLight expected_sky = (*renderer)->sky();
  expected_sky.heading += glm::radians(turned_deg);

  const gl::Texture target = gl::texture_2d(GL_RGBA32F, size, size);
  gl::Texture depth = gl::texture_2d(GL_DEPTH_COMPONENT32F, size, size);
  const gl::Framebuffer framebuffer = gl::Framebuffer::create();
  glNamedFramebufferTexture(framebuffer.name(), GL_COLOR_ATTACHMENT0, target.name(), 0);
  glNamedFramebufferTexture(framebuffer.name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
  DrawnSkyError error;
  double off_model = 0.0, luminance_of_all = 0.0;
  const float turn = -glm::radians(turned_deg);
  const glm::mat3 turned(std::cos(turn), std::sin(turn), 0, -std::sin(turn), std::cos(turn), 0, 0, 0, 1);
  for (int face = 0; face < 6; ++face) {
    const Camera camera = view_of_sky(face);
    (*renderer)->begin_frame(scene, camera);
    render::View view = render::camera_view(camera, framebuffer.name(), size, size);
    view.kind = render::ViewKind::cube_face;
    (*renderer)->draw_view(view);
    std::vector<glm::vec4> drawn(std::size_t(size) * size);
    glGetTextureImage(target.name(), 0, GL_RGBA, GL_FLOAT, GLsizei(drawn.size() * sizeof(glm::vec4)),
                      drawn.data());
    std::vector<glm::vec3> expected(drawn.size());
    double mean = 0.0;
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        const glm::vec2 at(float(x) + 0.5f, float(size - y) - 0.5f);
        const std::size_t i = std::size_t(y) * size + std::size_t(x);
        glm::vec3& value = expected[i];
        const glm::vec3 direction = reference::camera_ray(camera, size, size, at).direction;
        value = shading::sky_radiance(expected_sky, direction, 0.0f);
        mean += double(value.y) / double(size * size);
        const glm::vec3 model = displayable((*sky)->sky_radiance_xyz(turned * direction));
        const glm::vec3 off = glm::abs(glm::vec3(drawn[i]) - model);
        off_model += double(off.x + off.y + off.z) / 3.0, luminance_of_all += double(model.y);
      }
    for (std::size_t i = 0; i < drawn.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double value = double(expected[i][c]), off = std::abs(double(drawn[i][c]) - value);
        error.of_build = worse(error.of_build, off / std::max({value, mean, 1e-12}));
        ++error.samples;
      }
  }
  error.of_model = off_model / std::max(luminance_of_all, 1e-12);
  return error;
}

}  // namespace parvis::light
