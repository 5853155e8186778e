#include "graphics/shading/glass.h"

#include <gtest/gtest.h>

#include "graphics/shading/test_axes.h"

namespace parvis::shading {
namespace {

vec3 at_angle(float angle) { return {std::sin(angle), 0.0f, -std::cos(angle)}; }  // down upon the plane z = 0

TEST(Glass, BendsRaysBySnellsLaw) {
  for (const float ior : {1.1f, 1.5f, 2.4f})
    for (const float angle : {0.0f, 0.3f, 0.9f, 1.5f}) {
      const vec3 inside = refracted(at_angle(angle), up, 1.0f / ior);
      EXPECT_NEAR(length(inside), 1.0f, 1e-6f);
      EXPECT_NEAR(ior * inside.x, std::sin(angle), 1e-6f);
      const vec3 outside = refracted(inside, up, ior);
      EXPECT_LT(length(outside - at_angle(angle)), 2e-5f) << "through a pane a ray keeps its direction";
    }
}

TEST(Glass, ReflectsAllLightBeyondTheCriticalAngle) {
  const float critical = std::asin(1.0f / 1.5f);
  EXPECT_EQ(refracted(at_angle(critical + 1e-3f), up, 1.5f), vec3(0.0f));
  EXPECT_GT(length(refracted(at_angle(critical - 1e-3f), up, 1.5f)), 0.9f);
  EXPECT_FLOAT_EQ(inner_reflectance(1.5f, 0.0f), 1.0f);
  EXPECT_FLOAT_EQ(inner_reflectance(1.5f, 1.0f), 0.04f);
}

TEST(Glass, ASurfaceReflectsByItsIndexAndScattersNothing) {
  Surface s{up, vec3(0.8f), 0.0f, 0.0f, 1.0f, 0.0f, 0.5f, 1.0f, vec3(0.0f)};
  s = glass_surface(s, 2.0f);
  EXPECT_NEAR(base_reflectance(s, 1.0f).x, 1.0f / 9.0f, 5e-3f);
  EXPECT_GT(base_reflectance(s, 0.02f).x, 0.8f);
  const vec3 light = ambient_radiance(s, up, vec3(3.0f), vec3(3.0f), vec3(0.0f), vec3(0.0f));
  EXPECT_EQ(light, vec3(0.0f)) << "no light from the sides";
}

}  // namespace
}  // namespace parvis::shading
