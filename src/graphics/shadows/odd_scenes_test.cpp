// Every method of shadows with a sun below the horizon, and with a mesh that is inside out: pictures of
// finite light, and no sun where there is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "graphics/gl/test_context.h"
#include "graphics/light/shadow_settings.h"
#include "graphics/render/frame_views.h"
#include "graphics/render/renderer.h"
#include "graphics/shadows/chosen_light.h"
#include "scene/data/test_scene.h"

namespace parvis::shadows {
namespace {

class OddScenes : public gl::ContextTest {
 protected:
  OddScenes() {
    add(scene_, scene::model_of(scene::ground(60), scene::matt(glm::vec3(0.5f))));
    camera_.world_from_camera = look_at({-9, -12, 8}, {0, 0, 0});
    camera_.vertical_fov = 0.9f;
  }
  ImageF drawn(light::ShadowTechnique technique) {
    scene_.data<light::ShadowSettings>().technique = technique;
    auto renderer = render::Renderer::create(scene_, {}, ChosenLight::create);
    EXPECT_TRUE(renderer) << to_string(renderer.errors());
    EXPECT_TRUE(render::draw_frame(**renderer, scene_, {camera_, 96, 64}));
    return (*renderer)->read_radiance();
  }
  void expect_finite(const char* what) {
    for (std::size_t t = 0; t < light::shadow_technique_names.size(); ++t) {
      const ImageF picture = drawn(light::ShadowTechnique(t));
      EXPECT_TRUE(std::ranges::all_of(picture.pixels, [](float v) { return std::isfinite(v) && v >= 0.0f; }))
          << what << ", " << light::shadow_technique_names[t];
    }
  }

  scene::Scene scene_;
  Camera camera_;
};

TEST_F(OddScenes, ASunBelowTheHorizonLightsNoGround) {
  add(scene_, scene::model_of(scene::box({-2, -2, 0}, {2, 2, 3}), scene::matt(glm::vec3(0.5f))));
  scene_.sky.intensity = 0.0f;
  for (const float height : {-0.01f, -0.3f, -1.0f}) {
    scene_.sun.direction_to_sun = glm::normalize(glm::vec3(0.5f, -0.4f, height));
    expect_finite("a sun below the horizon");
    for (std::size_t t = 0; t < light::shadow_technique_names.size(); ++t)
      EXPECT_LT(drawn(light::ShadowTechnique(t)).at(8, 56)[1], 1e-3f)
          << "the ground, " << light::shadow_technique_names[t] << ", height " << height;
  }
}

TEST_F(OddScenes, AMeshInsideOutIsDrawn) {
  Mesh inside_out = scene::box({-3, -3, 0}, {-1, -1, 3});
  for (std::size_t i = 0; i + 2 < inside_out.indices.size(); i += 3)
    std::swap(inside_out.indices[i + 1], inside_out.indices[i + 2]);
  for (glm::vec3& normal : inside_out.normals) normal = -normal;
  add(scene_, scene::model_of(inside_out, scene::matt(glm::vec3(0.5f))));
  scene_.sun.direction_to_sun = glm::normalize(glm::vec3(0.5f, -0.4f, 0.6f));
  expect_finite("a mesh inside out");
}

}  // namespace
}  // namespace parvis::shadows
