#include "graphics/light/shadow_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "graphics/light/test_box.h"
#include "graphics/light/test_shadow_check.h"

namespace parvis::light {
namespace {

const glm::vec3 suns[] = {{0.6f, -0.5f, 0.62f},
                          {0.0f, 0.8f, 0.6f},
                          {0.0f, -0.8f, 0.6f},
                          {0.9f, 0.0f, 0.436f},
                          {0.01f, 0.0f, 0.99995f}};

Camera street_camera() {
  Camera camera;
  camera.world_from_camera = look_at({0, -20, 1.6f}, {2, 30, 2});
  return camera;
}

SeenSurfaces street() {
  SeenSurfaces seen;
  Random random(1);
  const Camera camera = street_camera();
  for (int i = 0; i < 400; ++i) {
    const glm::vec3 point(random.uniform(-8.0f, 8.0f), random.uniform(-12.0f, 60.0f),
                          random.uniform(0.0f, 3.0f));
    seen.positions.push_back(point);
    seen.depths_m.push_back(glm::dot(point - camera.position_in_world(), camera.forward_in_world()));
  }
  return seen;
}

Bounds casters() {
  Bounds bounds;
  bounds.add({-40, -40, 0}), bounds.add({40, 80, 20});
  return bounds;
}

TEST(ShadowFit, MapsHoldEverySeenPointAndKeepRaysToTheSunInOneTexel) {
  const SeenSurfaces seen = street();
  for (const glm::vec3 sun : suns)
    for (std::size_t m = 0; m < shadow_method_names.size(); ++m) {
      const glm::vec3 to_sun = glm::normalize(sun);
      const auto maps = fit_shadow_maps(ShadowMethod(m), street_camera(), to_sun, seen, casters());
      for (std::size_t i = 0; i < seen.positions.size(); ++i) {
        const ShadowMap& map = map_for_depth(maps, double(seen.depths_m[i]));
        const auto at = [&](glm::dvec3 p) {
          const glm::dvec4 h = map.map_from_world * glm::dvec4(p, 1.0);
          return glm::dvec3(h) / h.w;
        };
        const glm::dvec3 point(seen.positions[i]), here = at(point),
                                                   toward = at(point + 5.0 * glm::dvec3(to_sun));
        EXPECT_LE(std::abs(here.x), 1.0 + 1e-6) << shadow_method_names[m];
        EXPECT_LE(std::abs(here.y), 1.0 + 1e-6) << shadow_method_names[m];
        EXPECT_NEAR(here.x, toward.x, 1e-5) << shadow_method_names[m] << ' ' << i;
        EXPECT_NEAR(here.y, toward.y, 1e-5) << shadow_method_names[m] << ' ' << i;
      }
    }
}

TEST(ShadowFit, TexelsAreSmallerNearTheViewer) {
  const SeenSurfaces seen = street();
  const glm::vec3 to_sun = glm::normalize(glm::vec3(0.7f, -0.1f, 0.7f));
  const auto size = [&](ShadowMethod method, glm::vec3 point) {
    const Camera camera = street_camera();
    const auto maps = fit_shadow_maps(method, camera, to_sun, seen, casters());
    const float depth = glm::dot(point - camera.position_in_world(), camera.forward_in_world());
    return texel_point(map_for_depth(maps, double(depth)), 2048, glm::dvec3(point)).size_m;
  };
  const glm::vec3 near(0, -11, 0), far(2, 55, 0);
  for (const ShadowMethod method :
       {ShadowMethod::cascades, ShadowMethod::perspective, ShadowMethod::light_space_perspective}) {
    EXPECT_LT(size(method, near), 0.75 * size(ShadowMethod::uniform, near)) << int(method);
    EXPECT_LT(size(method, near), 0.75 * size(method, far)) << int(method);
  }
  EXPECT_NEAR(size(ShadowMethod::uniform, near), size(ShadowMethod::uniform, far), 1e-9);
}

TEST(ShadowFit, NothingSeenGivesAMapOfTheCasters) {
  const auto maps = fit_shadow_maps(ShadowMethod::cascades, street_camera(), {0, 0, 1}, {}, casters());
  ASSERT_EQ(maps.size(), 1u);
  EXPECT_GT(texel_point(maps[0], 1024, {0, 0, 0}).size_m, 0.05);
}

TEST(ShadowCheck, FinerMapsHaveFewerWrongPixels) {
  const scene::Scene scene = box_on_a_plain({-4, 2, 0}, {5, 6, 8});
  const reference::RayScene rays(scene);
  const auto errors = [&](int resolution) {
    return check_shadows(rays, casters(), street_camera(), 160, 90,
                         glm::normalize(glm::vec3(0.5f, 0.4f, 0.7f)), resolution);
  };
  const ShadowErrors coarse = errors(64), fine = errors(4096);
  EXPECT_GT(fine.pixels, 1000);
  for (std::size_t m = 0; m < shadow_method_names.size(); ++m) {
    EXPECT_LT(fine.percent(ShadowMethod(m)), 0.5) << shadow_method_names[m];
    EXPECT_LT(fine.wrong[m], coarse.wrong[m]) << shadow_method_names[m];
  }
}

}  // namespace
}  // namespace parvis::light
