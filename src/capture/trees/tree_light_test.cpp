#include "capture/trees/tree_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/colour.h"
#include "capture/trees/test_volume.h"
#include "capture/trees/tree_levels.h"

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

/// The green of each cell's base, linear, as another sun shows it.
std::vector<float> shown(const TreeLevels& tree, glm::vec3 to_sun, float sun, float sky) {
  const CellShares suns = sun_shares(tree, to_sun);
  std::vector<float> result;
  for (std::size_t i = 0; i < suns[0].size(); ++i) {
    const float albedo = tree.crown.albedo_factor[0][i] *
                         linear_from_srgb(float(tree.levels[0].base[i].y) / 255.0f) / mean_albedo;
    result.push_back(albedo * (sun * suns[0][i] + sky * tree.crown.sky[0][i]));
  }
  return result;
}

TEST(CrownLight, InTheirOwnLightTexturesStayAsTheyAre) {
  const TreeLevels tree = levels_of(lit_ball(south, 0.5f, 0.2f));
  const CapturedLight& light = tree.levels[0].light;
  const std::vector<float> same = shown(tree, light.to_sun, light.sun, light.sky);
  for (std::size_t i = 0; i < same.size(); ++i)
    EXPECT_NEAR(same[i], linear_from_srgb(float(tree.levels[0].base[i].y) / 255.0f), 1e-4f);
}

TEST(CrownLight, AnotherSunIsPutIn) {
  const TreeLevels before = levels_of(lit_ball(south, 0.5f, 0.2f));
  const BillboardTree truth = lit_ball(east, 0.5f, 0.2f);
  const std::vector<float> after = shown(before, east, 0.5f, 0.2f);
  double error = 0.0, baked_error = 0.0;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const double wanted = linear_from_srgb(float(truth.base[i].y) / 255.0f);
    error += std::abs(double(after[i]) - wanted);
    baked_error += std::abs(double(linear_from_srgb(float(before.levels[0].base[i].y) / 255.0f)) - wanted);
  }
  EXPECT_LT(error, 0.35 * baked_error);
}

TEST(CrownLight, CoarserLevelsAreAsBright) {
  const TreeLevels tree = levels_of(lit_ball(south, 0.5f, 0.2f));
  const CellShares suns = sun_shares(tree, east);
  ASSERT_EQ(suns.size(), tree.levels.size());
  const auto mean = [&](std::size_t level) {
    double sum = 0.0, weights = 0.0;
    for (std::size_t i = 0; i < suns[level].size(); ++i) {
      const double weight = level == 0 ? 1.0 : double(tree.levels[level].base[i].w);
      sum += weight * double(suns[level][i]), weights += weight;
    }
    return sum / weights;
  };
  EXPECT_EQ(suns.back().size(), 1u);
  EXPECT_NEAR(mean(suns.size() - 1), mean(0), 0.02);
}

TEST(CrownLight, IsKeptUntilTheSunHasMoved) {
  const TreeLevels tree = levels_of(lit_ball(south, 0.5f, 0.2f));
  SunInCrowns crowns;
  const CellShares first = crowns.shares(tree, south);
  EXPECT_EQ(crowns.shares(tree, glm::normalize(south + glm::vec3(0.005f, 0.0f, 0.0f))), first);
  EXPECT_NE(crowns.shares(tree, east), first);
}

TEST(CrownLight, EndsWhereTheBoxDoes) {
  const Bounds box{{0, 0, 0}, {2, 2, 4}};
  EXPECT_NEAR(way_out(box, {1, 1, 1}, {0, 0, 1}), 3.0f, 1e-6f);
  EXPECT_NEAR(way_out(box, {1, 1, 1}, glm::normalize(glm::vec3(1, 0, 1))), std::sqrt(2.0f), 1e-6f);
  EXPECT_EQ(way_out(box, {1, 1, 5}, {0, 0, 1}), 0.0f) << "outside";
}

}  // namespace
}  // namespace parvis::trees
