#include "graphics/render/regions.h"

#include <gtest/gtest.h>

#include "graphics/shading/heightfield.h"
#include "scene/data/test_scene.h"

namespace parvis::render {
namespace {

Bounds at(float x, float y, float height_m = 1.0f) { return {{x, y, 0}, {x + 2, y + 2, height_m}}; }

TEST(Regions, ThoseThatTouchBecomeOne) {
  EXPECT_TRUE(united({}, 5.0f).empty());
  EXPECT_EQ(united({at(0, 0), at(10, 0)}, 0.0f).size(), 2u);
  EXPECT_EQ(united({at(0, 0), at(10, 0)}, 4.0f).size(), 1u);
  // The third joins the first two, which lie apart.
  const std::vector<Bounds> one = united({at(0, 0), at(4, 0), at(1, 0), at(3, 1)}, 0.0f);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].min, glm::vec3(0));
  EXPECT_EQ(one[0].max, glm::vec3(6, 3, 1));
}

TEST(Regions, HeightsOfARebuiltRegionAreThoseOfThePlaceAsItIs) {
  const Bounds place{{-20, -20, 0}, {20, 20, 9}};
  const Mesh wide = scene::box({-15, -3, 0}, {15, 3, 4}), tower = scene::box({-2, -6, 0}, {5, 6, 9});
  shading::Heightfield with(place), without(place);
  for (shading::Heightfield* heights : {&with, &without}) heights->add(wide, glm::mat4(1.0f));
  with.add(tower, glm::mat4(1.0f));
  ASSERT_NE(with.heights().pixels, without.heights().pixels);
  const Bounds left = tower.bounds();
  with.clear(left);
  with.add(wide, glm::mat4(1.0f), &left);
  EXPECT_EQ(with.heights().pixels, without.heights().pixels);
  with.clear({{50, 50, 0}, {60, 60, 1}});  // outside of the place
  EXPECT_EQ(with.heights().pixels, without.heights().pixels);
}

}  // namespace
}  // namespace parvis::render
