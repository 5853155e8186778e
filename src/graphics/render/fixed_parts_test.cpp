#include "graphics/render/fixed_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "scene/data/test_scene.h"

namespace parvis::render {
namespace {

class Plain final : public scene::TracedSurface {
  scene::TracedPoint point(const scene::TracedHit&) const override { return {}; }
};

/// A house of 9 m that a room draws, and a slab 40 m above it.
scene::Scene house_below(bool slab_casts_shadow) {
  scene::Scene scene;
  const auto trace = [slab_casts_shadow](const scene::Scene&, scene::TracedScene& traced) {
    const auto add = [&](const Mesh& mesh, bool casts_shadow) {
      scene::TracedPlacing placing;
      placing.casts_shadow = casts_shadow;
      traced.add(std::make_shared<const Mesh>(mesh), std::make_shared<const Plain>(), glm::mat4(1.0f),
                 placing);
    };
    add(scene::box({-2, -6, 0}, {5, 6, 9}), true);
    add(scene::box({-90, -90, 49}, {90, 90, 50}), slab_casts_shadow);
  };
  scene.traced_kinds.push_back({"captured", [](const scene::Scene&) { return 1; }, trace});
  return scene;
}

TEST(FixedParts, ABackdropHidesNoSky) {
  const Bounds below = bounds_of_fixed_parts(house_below(false), true);
  EXPECT_EQ(below.min, glm::vec3(-2, -6, 0));
  EXPECT_EQ(below.max, glm::vec3(5, 6, 9));
  EXPECT_EQ(bounds_of_fixed_parts(house_below(true), true).max.z, 50.0f);

  shading::Heightfield open({{-20, -20, 0}, {20, 20, 60}}), covered = open;
  add_fixed_parts(house_below(false), open);
  add_fixed_parts(house_below(true), covered);
  const auto highest = [](const shading::Heightfield& heights) {
    return *std::ranges::max_element(heights.heights().pixels);
  };
  EXPECT_NEAR(highest(open), 9.0f, 0.01f);
  EXPECT_NEAR(highest(covered), 50.0f, 0.01f);
}

}  // namespace
}  // namespace parvis::render
