#include "capture/trees/tree_light.h"

#include <gtest/gtest.h>

#include "base/colour.h"
#include "capture/trees/test_volume.h"
#include "capture/trees/tree_volume.h"

namespace parvis::trees {
namespace {

/// A dense ball whose cells are as bright as the sun and the sky that they see make them.
BillboardTree lit_ball(glm::vec3 to_sun, float sun, float sky) {
  BillboardTree tree;
  const TestVolume ball(27, 0.5f);
  tree.grid = ball.grid;
  tree.base.assign(tree.grid.size(), {0, 0, 0, 150});
  const std::vector<float> seen_sun = sun_visibility(tree, to_sun), seen_sky = sky_visibility(tree);
  for (std::size_t i = 0; i < tree.base.size(); ++i) {
    const float light = srgb_from_linear(sun * seen_sun[i] + sky * seen_sky[i]);
    for (int c = 0; c < 3; ++c) tree.base[i][c] = std::uint8_t(std::lround(255.0f * light));
  }
  tree.light = estimated_light(tree);
  return tree;
}

const glm::vec3 south = glm::normalize(glm::vec3(0.0f, -1.0f, 1.0f));
const glm::vec3 east = glm::normalize(glm::vec3(1.0f, 0.0f, 0.6f));

TEST(TreeLight, IsFoundInTheTextures) {
  for (const glm::vec3 to_sun : {south, east}) {
    const BillboardTree tree = lit_ball(to_sun, 0.5f, 0.2f);
    EXPECT_GT(glm::dot(tree.light.to_sun, to_sun), 0.96f);
    EXPECT_NEAR(tree.light.sun, 0.5f, 0.06f);
    EXPECT_NEAR(tree.light.sky, 0.2f, 0.06f);
  }
  // The control: where there is no sun none is found.
  EXPECT_LT(lit_ball(south, 0.0f, 0.4f).light.sun, 0.02f);
}

TEST(TreeLight, AnotherSunIsPutIn) {
  const BillboardTree before = lit_ball(south, 0.5f, 0.2f), truth = lit_ball(east, 0.5f, 0.2f);
  const BillboardTree after = relit(before, east);
  double error = 0.0, baked_error = 0.0;
  for (std::size_t i = 0; i < truth.base.size(); ++i) {
    error += std::abs(int(after.base[i].y) - int(truth.base[i].y));
    baked_error += std::abs(int(before.base[i].y) - int(truth.base[i].y));
  }
  EXPECT_LT(error, 0.35 * baked_error);
}

TEST(TreeLight, AlbedoIsTheSameWhateverTheSun) {
  const BillboardTree first = unlit(lit_ball(south, 0.5f, 0.2f), 6.0f),
                      second = unlit(lit_ball(east, 0.4f, 0.3f), 6.0f);
  double difference = 0.0, sum = 0.0;
  for (std::size_t i = 0; i < first.base.size(); ++i) {
    difference += std::abs(int(first.base[i].y) - int(second.base[i].y));
    sum += double(first.base[i].y);
  }
  // The sun is searched in steps of 15 degrees. With the light left in they differ by 0.35.
  EXPECT_LT(difference, 0.15 * sum);
}

}  // namespace
}  // namespace parvis::trees
