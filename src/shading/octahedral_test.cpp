#include "shading/octahedral.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace parvis::shading {
namespace {

glm::vec3 chance_direction(Random& random) {
  glm::vec3 d;
  do d = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  while (glm::length(d) > 1.0f || glm::length(d) < 0.01f);
  return glm::normalize(d);
}

TEST(Octahedral, EveryDirectionComesBack) {
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const glm::vec3 d = chance_direction(random);
    const glm::vec2 uv = octahedral_uv(d);
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(uv, glm::vec2(0.0f))) &&
                glm::all(glm::lessThanEqual(uv, glm::vec2(1.0f))));
    ASSERT_LT(glm::distance(octahedral_direction(uv), d), 3e-5f) << "as far as the arc tangent is exact";
    ASSERT_LT(glm::distance(layer_direction(layer_uv(d, 256.0f, 4.0f), 256.0f, 4.0f), d), 1e-4f);
  }
}

TEST(Octahedral, EqualAreasShowEqualSolidAngles) {
  constexpr float step = 1e-3f;
  for (float v = 0.03f; v < 1.0f; v += 0.05f)
    for (float u = 0.02f; u < 1.0f; u += 0.05f) {
      const auto at = [&](float du, float dv) { return octahedral_direction({u + du, v + dv}); };
      const glm::vec3 along_u = (at(step, 0) - at(-step, 0)) / (2.0f * step);
      const glm::vec3 along_v = (at(0, step) - at(0, -step)) / (2.0f * step);
      ASSERT_NEAR(glm::length(glm::cross(along_u, along_v)), 4.0f * 3.14159265f, 0.4f) << u << " " << v;
    }
}

// What lies a little beyond a side is what lies a little within another part of that side.
TEST(Octahedral, TheMapGoesOnAcrossItsSides) {
  constexpr float step = 1e-3f;
  for (float along = 0.05f; along < 1.0f; along += 0.1f)
    for (const glm::vec2 outward : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)}) {
      const glm::vec2 middle = 0.5f + 0.5f * outward;
      const glm::vec2 side = middle + (along - 0.5f) * glm::vec2(-outward.y, outward.x);
      const glm::vec3 within = octahedral_direction(side - step * outward),
                      beyond = octahedral_direction(side + step * outward);
      ASSERT_LT(glm::distance(within, beyond), 12.0f * step)
          << "two steps of 3.5 rad a side, stretched a little";
      ASSERT_GT(glm::distance(within, beyond), 0.5f * step) << "it goes on, and does not come back";
    }
}

}  // namespace
}  // namespace parvis::shading
