#include "graphics/shading/octahedral.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "base/test_directions.h"

namespace parvis::shading {
namespace {

TEST(Octahedral, EveryDirectionComesBack) {
  Random random(1);
  for (int i = 0; i < 10000; ++i) {
    const glm::vec3 d = random_direction(random);
    const glm::vec2 uv = octahedral_uv(d);
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(uv, glm::vec2(0.0f))) &&
                glm::all(glm::lessThanEqual(uv, glm::vec2(1.0f))));
    ASSERT_LT(glm::distance(octahedral_direction(uv), d), 1e-5f);
    ASSERT_LT(glm::distance(layer_direction(layer_uv(d, 256.0f, 4.0f), 256.0f, 4.0f), d), 1e-4f);
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
      ASSERT_LT(glm::distance(within, beyond), 8.0f * step);
      ASSERT_GT(glm::distance(within, beyond), 0.5f * step) << "it goes on, and does not come back";
    }
}

}  // namespace
}  // namespace parvis::shading
